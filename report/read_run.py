"""A run folder as data: what is there is read, what is not is noted and never an error."""

import csv
import json
import math
import pathlib
import tomllib

import numpy


class Table:
    """A CSV file of a run: lines `# key: value`, a header row, numbers. `notes` and `columns` by name."""

    def __init__(self, path):
        self.notes = {}
        self.columns = {}
        header, rows = None, []
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.reader(file):
                if not row:
                    continue
                if row[0].startswith("#"):
                    key, _, value = ",".join(row).lstrip("# ").partition(":")
                    self.notes[key.strip()] = value.strip()
                elif header is None:
                    header = [name.strip() for name in row]
                elif len(row) == len(header):  # a row cut short by a stop is left out
                    rows.append([number(text) for text in row])
        if header is None or not rows:
            raise ValueError("no rows")
        values = numpy.array(rows, dtype=float)
        self.columns = {name: values[:, i] for i, name in enumerate(header)}

    def starting(self, prefix):
        """Columns named `prefix` or `prefix.something`: something (or "") -> values."""
        found = {}
        for name, values in self.columns.items():
            if name == prefix or name.startswith(prefix + "."):
                found[name[len(prefix) + 1:]] = values
        return found


class Run:
    """Everything the report uses, or None where the folder has nothing; `missing` says what and why."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.missing = []
        self.summary = self._try("summary.json", read_json) or {}
        self.resolved = self._try("resolved.toml", read_toml) or {}
        self.history = self._try("history.csv", Table)
        self.microphones = self._try("microphones.csv", Table)
        self.spectra = self._try("spectra.csv", Table)
        bands = self.folder / "third_octaves.csv"
        self.third_octaves = self._try(bands.name, Table) if bands.exists() else None
        self.fields = self._try("fields.h5", read_fields)
        kymograms = sorted(self.folder.glob("kymogram_*.csv"))
        self.kymogram = self._try(kymograms[0].name, Table) if kymograms else None

    def _try(self, name, reader):
        path = self.folder / name
        if not path.exists():
            self.missing.append((name, "is not in the run folder"))
            return None
        try:
            return reader(path)
        except Exception as problem:  # a broken file must not cost the rest of the report
            self.missing.append((name, f"could not be read: {type(problem).__name__}: {problem}"))
            return None

    def kinds(self):
        """Region name -> "fluid", "solid" or "air", as far as the resolved case tells."""
        regions = self.resolved.get("region", [])
        return {region.get("name"): region.get("kind") for region in regions if isinstance(region, dict)}

    def results(self):
        return self.summary.get("results") or {}

    def is_half_model(self, coordinates):
        """Whether y = 0 is a symmetry line: it bounds the mesh, and a flow says that it is one."""
        low, high = coordinates[:, 1].min(), coordinates[:, 1].max()
        if abs(low) > 1e-9 * (high - low) or high <= 0:
            return False
        flow = self.resolved.get("flow")
        if not isinstance(flow, dict):
            return True
        return any(boundary.get("kind") == "symmetry" for boundary in flow.get("boundary", []))

    def sounds(self):
        return sorted(self.folder.glob("microphone*.wav"))


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


def read_json(path):
    return json.loads(path.read_text(encoding="utf-8"))


def read_toml(path):
    return tomllib.loads(path.read_text(encoding="utf-8"))


def read_fields(path):
    from fields import Fields  # h5py is needed for this file only

    return Fields(path)
