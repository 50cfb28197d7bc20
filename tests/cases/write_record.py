"""Writes a flow record as another program would: the example of docs/flow-record.md."""

import h5py


def write_record(path, points, times, pressures, velocities):
    """points (V, d), times (T), pressures (T, V), velocities (T, V, d): numpy arrays of the other program, SI units"""
    with h5py.File(path, "w") as file:
        file.attrs["format"] = "vocalis flow record"
        file.attrs["version"] = 1
        file["mesh/coordinates"] = points
        file["time"] = times
        file["pressure"] = pressures
        file.create_dataset("velocity", data=velocities, compression="gzip", shuffle=True)
        file.attrs["steps"] = len(times)
