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
        if results.count(reference.result) > 1:
            fail("each result has one [[reference]]", f"{reference.result} twice", "leave out one of them")
        scale = reference.relative_to
        if isinstance(scale, str) and scale not in results:
            fail("relative_to must be a number, or a result that has a [[reference]]", f'"{scale}"',
                 did_you_mean(scale, results))
        if reference.value is None and not study.reference_point:
            fail(f"the [[reference]] of {reference.result} has no value", "no reference_point either",
                 "give a value, or name the finest point: [study] reference_point = { KEY = VALUE }")
    if not study.references and not study.reference_point:
        fail("a study needs something to measure errors against", "no [[reference]] and no reference_point",
             "add [[reference]] tables, or [study] reference_point = { KEY = VALUE }, the finest point")
