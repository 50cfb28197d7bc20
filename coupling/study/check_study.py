"""What is wrong with a study that only the whole file shows."""

from mistakes import UserError, did_you_mean


def check_study(study):
    def fail(rule, value, remedy):
        raise UserError(f"{study.path}: {rule}", value, remedy)

    if not study.axes and not study.chosen_points:
        fail("a study varies something", "no [[axis]] and no [[point]]", "add an [[axis]] with key and values")
    if study.vary == "points" and not study.chosen_points:
        fail('vary = "points" computes the [[point]] tables', "none", "add [[point]] tables, or leave out vary")
    keys = [key for axis in study.axes for key in axis.keys]
    for key in keys:
        if keys.count(key) > 1:
            fail("two axes must not set the same key", key, "leave out one of them")
    varied = study.varied_keys()
    for name, settings in (("default", study.default), ("reference_point", study.reference_point)):
        for key in settings:
            if key not in varied:
                fail(f"{name} must name keys that the study varies", f'"{key}"', did_you_mean(key, varied))
    results = [reference.result for reference in study.references]
    for reference in study.references:
        scale = reference.relative_to
        if isinstance(scale, str) and scale not in results:
            fail("relative_to must be a number, or a result that has a [[reference]]", f'"{scale}"',
                 did_you_mean(scale, results))
        if reference.value == 0 and scale is None:
            fail("an error relative to 0 has no meaning", f"{reference.result} = 0",
                 f'give a scale: [[reference]] result = "{reference.result}" and relative_to')
        if reference.value is None and not study.reference_point:
            fail(f"the [[reference]] of {reference.result} has no value", "none in the case, and no reference_point",
                 "give a value, or name the finest point: [study] reference_point = { KEY = VALUE }")
    if not study.references and not study.reference_point:
        fail("a study needs something to measure errors against", "no [[reference]], [expected] or reference_point",
             "add [[reference]] tables, or [study] reference_point = { KEY = VALUE }, the finest point")


def check_names(study):
    """Each result has one [[reference]], before what the case expects comes to them."""
    results = [reference.result for reference in study.references]
    for result in results:
        if results.count(result) > 1:
            raise UserError(f"{study.path}: each result has one [[reference]]", f"{result} twice", "leave out one")
