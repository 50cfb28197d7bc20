"""The mistakes: each is a sound case with one thing wrong.

Mistake(name, case, change, words, ...): `change` is a list of (text of the case, what stands there instead); the
message must hold all `words`, which name the place, the rule, or the remedy.
"""

from dataclasses import dataclass, field


@dataclass
class Mistake:
    name: str
    case: str
    change: list = field(default_factory=list)
    words: list = field(default_factory=list)
    arguments: list = field(default_factory=list)
    command: str = "check"


def scene(name, old, new, *words):
    return Mistake(name, "scene.toml", [(old, new)], list(words))


def override(name, assignment, *words):
    return Mistake(name, "scene.toml", [], list(words), ["--set", assignment])


def mesh(name, file, *words):
    key = "geometry" if file.endswith(".geo") else "file"
    return Mistake(name, "square.toml", [('file = "two_cells.msh"', f'{key} = "{file}"')], [file, *words])


def source(name, keys, *words):
    """A mistake in a signal as the source; keys beside file."""
    return Mistake(name, "square.toml", [('kind = "gaussian_pulse"', 'kind = "signal"\n' + keys)], list(words))


def given(name, keys, *words):
    """A mistake in a flow that is not solved."""
    return Mistake(name, "square.toml", [('[source]\nkind = "gaussian_pulse"\ngroup = "inlet"\n', "[flow]\n" + keys + "\n"),
                                         ('kind = "air"', 'kind = "fluid"'), ("end = 1e-3", "end = 1e-3\ndt = 1e-4")],
                   list(words))


MISTAKES = [
    # The text of the case
    scene("unknown key", "viscosity = ", "viscosty = ", "scene.toml:28", "viscosty", "did you mean \"viscosity\""),
    scene("unknown table", "[output]", "[ouput]", "ouput", "did you mean \"output\""),
    scene("unknown key in an array", "ramp = 1e-3", "rmap = 1e-3", "flow.boundary[inlet].rmap", "ramp"),
    scene("invalid TOML", "density = 1.2", "density = = 1.2", "scene.toml:27", "TOML"),
    scene("key twice", "density = 1.2", "density = 1.2\ndensity = 1.3", "scene.toml:28", "TOML"),
    scene("text for a number", "density = 1.2", 'density = "1.2"', "scene.toml:27", "flow.density", "without quotes"),
    scene("value with a unit", "end = 4e-5", 'end = "10 ms"', "time.end", "10 ms", "[s]", "unit"),
    scene("number for a text", 'kind = "fluid"', "kind = 1", "region[duct].kind", "in quotes"),
    scene("boolean for a number", "dt = 1e-5\nscheme", "dt = true\nscheme", "time.dt", "true"),
    scene("table for a number", "density = 1.2", "density = { value = 1.2 }", "flow.density", "a table"),
    scene("real for a whole number", "checkpoint_steps = 2", "checkpoint_steps = 2.5", "checkpoint_steps", "whole"),
    scene("one table for many", "[[microphone]]", "[microphone]", "microphone", "[[microphone]]"),
    scene("missing key", "end = 4e-5\n", "", "time.end is needed", "[s]"),
    scene("missing table", "[time]\nend = 4e-5\ndt = 1e-5\nscheme = \"bdf2\"\n", "", "time is needed"),
    # Values out of range
    scene("not a number", "density = 1.2", "density = nan", "flow.density", "finite", "nan"),
    scene("infinite", "end = 4e-5", "end = inf", "time.end", "finite", "inf"),
    scene("negative density", "density = 1.2", "density = -1.2", "flow.density", "positive", "-1.2"),
    scene("no step", "dt = 1e-5\nscheme", "dt = 0\nscheme", "time.dt", "positive"),
    scene("step longer than the run", "dt = 1e-5\nscheme", "dt = 1\nscheme", "time.dt", "time.end"),
    scene("largest step below the step", "end = 4e-5", "end = 4e-5\ntolerance = 1e-3\nlargest_dt = 1e-6",
          "time.largest_dt", "time.dt"),
    scene("step tolerance out of range", "end = 4e-5", "end = 4e-5\ntolerance = 2", "time.tolerance", "from 0 to 1"),
    scene("smoother's quality out of range", "density = 1.2", "smoother_quality = 1.5\ndensity = 1.2",
          "flow.smoother_quality", "from 0 to 1"),
    scene("groups that are no list", 'kind = "flux"\ngroup = "mouth"', 'kind = "force"\ngroups = "mouth"',
          "monitor[flow].groups", "square brackets"),
    scene("line without length", 'kind = "flux"\ngroup = "mouth"',
          'kind = "flux"\nfrom = [0.01, 0]\nto = [0.01, 0]', "monitor[flow].to", "another point"),
    scene("compressible with ratio one half", "poisson_ratio = 0.4", "poisson_ratio = 0.5", "incompressible = true"),
    scene("theta without its scheme", 'scheme = "bdf2"', 'scheme = "bdf2"\ntheta = 0.5', "time.theta", "theta"),
    scene("theta below one half", 'scheme = "bdf2"', 'scheme = "theta"\ntheta = 0.3', "time.theta", "from 0.5 to 1"),
    scene("point with one coordinate", "[0.025, 0.005]", "[0.025]", "microphone[ear].position", "2 to 3"),
    scene("point off the plane", "[0.025, 0.005]", "[0.025, 0.005, 0.1]", "microphone[ear].position", "2"),
    scene("point not finite", "[0.025, 0.005]", "[0.025, nan]", "microphone[ear].position", "finite"),
    # Names
    scene("unknown scheme", '"bdf2"', '"euler"', "time.scheme", "theta, bdf2"),
    scene("unknown elements", "density = 1.2", 'elements = "P3"\ndensity = 1.2', "flow.elements", "P1P1, P2P1"),
    scene("unknown kind of monitor", 'kind = "flux"', 'kind = "forces"', "monitor[flow].kind", "did you mean \"force\""),
    scene("unknown group of a force", 'kind = "flux"\ngroup = "mouth"', 'kind = "force"\ngroups = ["base", "walls_"]',
          "monitor[flow].groups", "did you mean \"walls\""),
    scene("unknown group of a second fold", 'kind = "flux"\ngroup = "mouth"',
          'kind = "glottis"\ngroup = "walls"\nother_group = "wals"', "monitor[flow].other_group",
          "did you mean \"walls\""),
    scene("glottis along an axis that the plane lacks", 'kind = "flux"\ngroup = "mouth"',
          'kind = "glottis"\ngroup = "walls"\nalong = "z"', 'monitor "flow"', "along", "an axis of the mesh"),
    scene("glottis of a second fold and a plane", 'kind = "flux"\ngroup = "mouth"',
          'kind = "glottis"\ngroup = "walls"\nother_group = "base"\nplane = 0', "monitor[flow]", "leave out"),
    scene("unknown analogy", '"pressure_rate"', '"presure_rate"', "analogy", "did you mean \"pressure_rate\""),
    scene("unknown material", "density = 1040", 'material = "steel"\ndensity = 1040', "material", "neo_hookean"),
    scene("unknown region", 'name = "room"', 'name = "rom"', "region[rom].name", "did you mean \"room\""),
    scene("region left out", '[[region]]\nname = "room"\nkind = "air"\n', "", "room", "[[region]]"),
    scene("unknown group", 'group = "inlet"', 'group = "inlett"', "inlett", "did you mean \"inlet\""),
    scene("unknown group of sound", 'group = "open"', 'group = "sky"', "acoustic[sound].boundary[sky].group", "sky"),
    scene("wall without mass", 'kind = "open"', 'kind = "yielding"\nmass = 0', "acoustic[sound].boundary[open].mass", "kg/m^2"),
    scene("mass of a wall that does not yield", 'kind = "open"', 'kind = "admittance"\nmass = 21', "mass"),
    Mistake("yielding wall of the explicit integrator", "scene.toml", [('kind = "open"', 'kind = "yielding"')],
            ["need the implicit integrator", "auto"], ["--set", 'acoustic.integrator="explicit"']),
    Mistake("explicit integrator with a spectral radius", "scene.toml", [], ["spectral_radius", "the implicit integrator"],
            ["--set", 'acoustic.integrator="explicit"', "--set", "acoustic.spectral_radius=0.8"]),
    override("spectral radius above one", "acoustic.spectral_radius=1.2", "from 0 to 1"),
    scene("own mesh by both ways", "[[microphone]]", '[acoustic.mesh]\ngeometry = "scene.geo"\nfile = "two_cells.msh"\n\n'
          "[[microphone]]", "acoustic[sound].mesh", "one of geometry and file"),
    scene("own mesh without the group", "[[microphone]]", '[acoustic.mesh]\nfile = "two_cells.msh"\n\n[[microphone]]',
          "acoustic[sound].boundary[open].group", "two_cells.msh"),
    scene("own mesh that strips", 'dt = 1e-5\n\n[[acoustic.boundary]]', 'dt = 1e-5\ncontact_cells = "strip"\n\n'
          '[acoustic.mesh]\ngeometry = "scene.geo"\n\n[[acoustic.boundary]]', "acoustic[sound].contact_cells", "keep"),
    scene("flow outside of the own mesh", "[[acoustic.boundary]]", '[acoustic.mesh]\ngeometry = "far_away.geo"\n\n'
          "[[acoustic.boundary]]", "all of the flow", "\"sound\"", "further outside"),
    scene("end of the flow that is no group", "[[acoustic.boundary]]", '[acoustic.mesh]\ngeometry = "scene.geo"\n'
          'flow_ends = ["moth"]\n\n[[acoustic.boundary]]', "acoustic[sound].mesh.flow_ends", "did you mean \"mouth\""),
    scene("layer on no side", "[[microphone]]", '[[acoustic.layer]]\nkind = "pml"\nsides = ["right"]\nthickness = 0.01\n'
          "[[microphone]]", "acoustic[sound].layer", "sides", "x_min, x_max"),
    scene("layer thinner than two cells", "[[microphone]]", '[[acoustic.layer]]\nkind = "pml"\nsides = ["x_max"]\n'
          "thickness = 1e-4\n[[microphone]]", "two cells", "twelve"),
    scene("two regions of one name", 'name = "room"', 'name = "duct"', "region", "name of its own", "duct"),
    scene("two boundaries of one group", "[time]", '[[flow.boundary]]\ngroup = "inlet"\nkind = "wall"\n[time]',
          "[[flow.boundary]] needs a group of its own", "inlet"),
    scene("two monitors of one name", "[output]", '[[monitor]]\nname = "flow"\nkind = "flux"\ngroup = "inlet"\n[output]',
          "[[monitor]] needs a name of its own", "flow"),
    scene("two microphones of one name", "[[monitor]]",
          '[[microphone]]\nname = "ear"\nposition = [0.0, 0.005]\n[[monitor]]', "microphone", "name of its own"),
    scene("name unfit for a file", 'name = "ear"', 'name = "e/ar"', "microphone", "letters, digits"),
    # Rules over several sections
    scene("no fluid for the flow", 'kind = "fluid"', 'kind = "air"', "flow", "region of fluid"),
    scene("boundary of the flow where no flow is", 'group = "mouth"\nkind = "outlet"', 'group = "open"\nkind = "outlet"',
          "where fluid or solid ends", "open"),
    scene("boundary of sound where no air ends", 'group = "open"\nkind', 'group = "base"\nkind', "where its air ends", "base"),
    scene("monitor where no flow is", 'kind = "flux"\ngroup = "mouth"', 'kind = "flux"\ngroup = "open"', 'monitor "flow"',
          "fluid or solid"),
    scene("film between walls that stick", "[time]", "[contact]\nalpha = 0.5\nfilm_viscosity = 1e-3\n[time]",
          "scene.toml:50", "contact.film_viscosity"),
    scene("flow and source", "[time]", '[source]\nkind = "lf"\ngroup = "inlet"\n[time]', "[flow]", "[source]"),
    scene("microphone in a solid", "[0.025, 0.005]", "[0.01, 0.002]", "microphone", "ear"),
    scene("monitor outside", 'kind = "flux"\ngroup = "mouth"', 'kind = "displacement"\nposition = [0.5, 0.005]',
          'monitor "flow"', "[0.5, 0.005]"),
    scene("monitor of pressure in a solid", 'kind = "flux"\ngroup = "mouth"', 'kind = "pressure"\nposition = [0.01, 0.002]',
          'monitor "flow"', "inside the fluid"),
    scene("monitor of force where no fluid is", 'kind = "flux"\ngroup = "mouth"', 'kind = "force"\ngroups = ["base"]',
          "force", "base"),
    scene("monitor columns of one name", '[output]', '[[monitor]]\nkind = "energy"\n[[monitor]]\nname = "more"\n'
          'kind = "energy"\n[output]', "energy_kinetic_J", "twice"),
    scene("far field in the plane", '[0.025, 0.005]', '[0.5, 0.005]\nkind = "far_field"\nsurface = "open"',
          "far-field", "three dimensions", 'kind = "mesh"'),
    scene("far field without surface", '[0.025, 0.005]', '[0.025, 0.005]\nkind = "far_field"', "microphone[ear].surface",
          "needed"),
    scene("far field of an unknown surface", '[0.025, 0.005]', '[0.5, 0.005]\nkind = "far_field"\nsurface = "opne"',
          "microphone[ear].surface", 'did you mean "open"'),
    scene("mirror of no axis", '[0.025, 0.005]',
          '[0.5, 0.005]\nkind = "far_field"\nsurface = "open"\nmirror = ["r"]\nmirror_at = [0]',
          "microphone[ear].mirror", "x, y or z"),
    scene("mirrors without places", '[0.025, 0.005]',
          '[0.5, 0.005]\nkind = "far_field"\nsurface = "open"\nmirror = ["x", "y"]\nmirror_at = [0]',
          "microphone[ear].mirror_at", "2"),
    scene("Curle of an unknown group", '[0.025, 0.005]', '[0.5, 0.005]\nkind = "curle"\ngroups = ["wals"]',
          "microphone[ear].groups", 'did you mean "walls"'),
    scene("Curle without groups", '[0.025, 0.005]', '[0.5, 0.005]\nkind = "curle"', "microphone[ear].groups", "needed"),
    scene("Curle too near", '[0.025, 0.005]', '[0.005, 0.011]\nkind = "curle"\ngroups = ["walls"]', "ear",
          "3 time steps of sound", "time.dt"),
    scene("surface of Ffowcs Williams and Hawkings that is open", '[0.025, 0.005]',
          '[0.5, 0.005]\nkind = "fwh"\ngroups = ["walls"]', "walls", "closed"),
    scene("surface that no fluid touches", '[0.025, 0.005]', '[0.5, 0.005]\nkind = "curle"\ngroups = ["open"]', "ear",
          "facets that the fluid touches"),
    scene("compact microphone on the mesh", '[0.025, 0.005]', '[0.025, 0.005]\ncompact = true', "microphone[ear].compact"),
    Mistake("Curle without a flow", "square.toml",
            [("[source]", '[[microphone]]\nname = "ear"\nposition = [9, 9]\nkind = "curle"\ngroups = ["inlet"]\n[source]')],
            ["microphone[ear].kind", "[flow]"]),
    scene("surface of a microphone on the mesh", '[0.025, 0.005]', '[0.025, 0.005]\nsurface = "open"',
          "microphone[ear].surface"),
    scene("microphone outside", "[0.025, 0.005]", "[0.5, 0.005]", "microphone", "ear"),
    Mistake("regions missing", "square.toml", [('[[region]]\nname = "air"\nkind = "air"\n', "")], ["[[region]]"]),
    Mistake("nothing moves the air", "square.toml", [('[source]\nkind = "gaussian_pulse"\ngroup = "inlet"\n', "")],
            ["[flow]", "[source]"]),
    Mistake("source of no kind", "square.toml", [('"gaussian_pulse"', '"rosenburg"')], ["source.kind", "rosenberg"]),
    Mistake("glottis open for longer than a period", "square.toml",
            [('"gaussian_pulse"', '"rosenberg"\nopen_quotient = 1.2')], ["source.open_quotient", "1.2"]),
    source("source of no file", "", "source.file is needed"),
    source("source of a missing file", 'file = "nowhere.wav"', "source.file", "nowhere.wav"),
    source("source of a letter", 'file = "letter.msh"', "letter.msh", "four samples"),
    source("source with a row that is no sample", 'file = "words.csv"', "words.csv:3", "one row a sample"),
    source("source whose time goes back", 'file = "back.csv"', "back.csv", "must increase", "sample 4"),
    source("source of no column", 'file = "click.csv"\ncolumn = "flov"', "click.csv", 'did you mean "flow"'),
    source("source that begins with a click", 'file = "click.csv"', "click.csv", "fade"),
    source("source that is no sound", 'file = "noise.wav"', "noise.wav", "sound file"),
    Mistake("source without sound", "square.toml", [("[[acoustic]]\ndt = 1e-4", ""), ("end = 1e-3", "end = 1e-3\ndt = 1e-4")],
            ["[[acoustic]]"]),
    scene("statistics of no column", "[output]", '[statistics]\nkind = "periodic"\nperiod_of = "flow"\n[output]',
          "statistics.period_of", "choose one of: flow_m2_s"),
    scene("statistics without monitors", '[[monitor]]\nname = "flow"\nkind = "flux"\ngroup = "mouth"\n',
          '[statistics]\nkind = "last"\n', "statistics", "[[monitor]]"),
    scene("statistics that begin too late", "[output]", '[statistics]\nkind = "extrema"\nbegin = 1\n[output]',
          "statistics.begin", "time.end"),
    scene("pressure stabilisation of Taylor-Hood", "density = 1.2",
          'elements = "P2P1"\npressure_stabilisation = false\ndensity = 1.2', "flow.pressure_stabilisation", "P1P1"),
    # A flow that is not solved
    given("flow by no formula", 'analytic = "vortexpair"', "flow.analytic", 'did you mean "vortex_pair"'),
    given("vortices of no strength", 'analytic = "vortex_pair"\nradius = 1\ncore_radius = 0.1', "flow.circulation is needed"),
    given("vortices without a core", 'analytic = "vortex_pair"\ncirculation = 1\nradius = 1\ncore_radius = 0',
          "flow.core_radius", "positive"),
    given("formula and record", 'analytic = "uniform"\nrecord = "letter.msh"', "formula", "both"),
    given("formula with a solver's key", 'analytic = "uniform"\nvelocity = [1, 0]\nviscosity = 1', "flow.viscosity"),
    given("formula and monitor", 'analytic = "uniform"\nvelocity = [1, 0]\n[[monitor]]\nkind = "energy"', "monitor",
          "a flow by a formula"),
    given("record that is not there", 'record = "nowhere.h5"', "flow.record", "nowhere.h5"),
    given("record that is a letter", 'record = "letter.msh"', "letter.msh", "must be whole"),
    given("precision of no kind", 'analytic = "uniform"\nvelocity = [1, 0]\n[record]\nprecision = "half"',
          "record.precision", "double, single"),
    Mistake("record without a flow", "square.toml", [("[time]", "[record]\n[time]")], ["record", "no [flow]"]),
    Mistake("replay of a case", "scene.toml", words=["resolved.toml"], command="replay"),
    # The mesh
    scene("missing geometry", '"scene.geo"', '"nowhere.geo"', "mesh.geometry", "nowhere.geo"),
    scene("geometry and mesh", '"scene.geo"', '"scene.geo"\nfile = "two_cells.msh"', "geometry", "file"),
    scene("list with a text", "h = 0.002", 'h = [0.002, "wide"]', "mesh.parameters.h", "number"),
    scene("unknown parameter", "h = 0.002", "hh = 0.002", "mesh.parameters", "hh"),
    mesh("empty geometry", "empty.geo"),
    mesh("geometry that Gmsh cannot read", "bad_syntax.geo"),
    mesh("geometry without named groups", "no_groups.geo", "group"),
    mesh("geometry without area", "only_curves.geo"),
    mesh("missing mesh", "nowhere.msh", "mesh.file"),
    mesh("file that is no mesh", "letter.msh"),
    mesh("mesh that ends too early", "truncated.msh"),
    mesh("cell without area", "flat_cell.msh"),
    mesh("vertex that is not a number", "nan_node.msh"),
    mesh("cell with a missing vertex", "missing_node.msh"),
    mesh("quadrangle", "quadrangle.msh", "triangle"),
    # The command
    override("unknown key in --set", "time.dtt=1e-6", "--set time.dtt=1e-6", "did you mean \"dt\""),
    override("--set without a value", "time.dt", "KEY=VALUE"),
    override("--set with an empty name", "time..dt=1", "--set time..dt=1"),
    override("--set of an element that is not there", "region.wall.density=1", "wall", "duct, block, room"),
    override("--set of an index too large", "acoustic.3.dt=1", "less than 1"),
    override("--set of a list without quotes", "acoustic.analogy=[lighthill, vortex]", "a list must be valid TOML", "'KEY=["),
    override("--set of a wrong value", "time.dt=fast", "--set time.dt=fast", "a number"),
    Mistake("unknown command", "scene.toml", words=["no such command", "run, check"], command="fly"),
    Mistake("misspelt command", "scene.toml", words=['did you mean "check"'], command="chek"),
    Mistake("no steps", "scene.toml", words=["--steps", "at least 1"], command="run", arguments=["--steps", "0"]),
    Mistake("resume of a case", "scene.toml", words=["scene.toml must be a run folder", "runs/"], command="resume"),
    Mistake("unknown option", "scene.toml", words=["--speed"], arguments=["--speed", "3"]),
    Mistake("run folder inside a file", "scene.toml", words=["scene.toml/run"], command="run",
            arguments=["--out", "{folder}/scene.toml/run"]),
]
