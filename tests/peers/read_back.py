"""Reads a file of ours as others do, with ncdump, netCDF4, h5netcdf and xarray (by netCDF4 and by h5netcdf, group by
group and as a tree where xarray has trees), and holds what they find against what was written:

    read_back.py FILE [--expected LINES] [--campbell CSV] [--history CSV]

A line of LINES is the path of a variable or, with @, of an attribute, and its values in order, separated by tabulators;
numbers have 17 digits. The tables are those that our programs write beside the file. Whatever the values, no reader may
miss a variable, name an axis itself, find an axis without its scale, warn, or see other values than the rest.
Exit code 0: all of it holds; 77: these modules are not there.
"""

import argparse
import csv
import math
import re
import shutil
import subprocess
import sys
import tempfile
import warnings

try:
    import h5netcdf
    import h5py
    import netCDF4
    import numpy
    import xarray
except ImportError as missing:
    print("skipped: %s (Debian: python3-xarray python3-netcdf4 python3-h5netcdf)" % missing)
    sys.exit(77)

ENGINES = ("netcdf4", "h5netcdf")


class Findings(list):
    """What is wrong, as one line each."""

    def check(self, what, found, wanted):
        if found != wanted:
            differ = [(a, b) for a, b in zip(found, wanted) if a != b] if isinstance(found, list) else []
            detail = "%s for %s" % differ[0] if differ else "%s for %s" % (str(found)[:200], str(wanted)[:200])
            self.append("%s: %s" % (what, detail))


def expected(path):
    found = {}
    with open(path, encoding="utf-8", newline="\n") as lines:
        for line in lines:
            name, *values = line.rstrip("\n").split("\t")
            found[name] = [value.replace("\\n", "\n") for value in values]
    return found


def texts(values):
    """Of an array of texts or numbers, in order."""
    array = numpy.ma.filled(values, b"\0") if getattr(values, "dtype", None) == "S1" else numpy.asarray(values)
    if array.dtype == "S1" and array.ndim > 0:  # characters that nobody has put together
        array = numpy.ascontiguousarray(array).view("S%d" % array.shape[-1])[..., 0]
    if array.dtype.kind in "OSU":
        return [v.decode("utf-8") if isinstance(v, bytes) else str(v) for v in array.ravel()]
    return ["%.17g" % v for v in array.ravel()]


def groups(dataset, path=""):
    yield path
    for name, group in dataset.groups.items():
        yield from groups(group, path + "/" + name)


def split(path):
    """Group, variable and attribute of "/group/variable@attribute"; the root is "", and has the variable ""."""
    owner, _, attribute = path.partition("@")
    group, _, variable = owner.rpartition("/")
    return group, variable, attribute


class Contents:
    """What is in the file, by h5py: the array of every path, and the scales of its axes."""

    def __init__(self, path, wrong):
        self.arrays, self.scales = {}, {}
        with h5py.File(path) as file:
            file.visititems(lambda name, item: self.note("/" + name, item, wrong))

    def note(self, name, item, wrong):
        if not isinstance(item, h5py.Dataset) or self.without_values(item):
            return
        self.arrays[name] = item[...]
        if item.dtype.kind not in "iufS":
            wrong.append("%s: numbers that netCDF does not know: %s" % (name, item.dtype))
        wanted = ("long_name",) if item.dtype.kind == "S" else ("long_name", "units")
        wrong.extend("%s: has no %s" % (name, a) for a in wanted if a not in item.attrs)
        if h5py.h5ds.is_scale(item.id):
            self.scales[name] = item[...]
            return
        for axis, dimension in enumerate(item.dims):
            if len(dimension) != 1:
                wrong.append("%s: axis %d has %d scales" % (name, axis, len(dimension)))

    @staticmethod
    def without_values(item):
        return b"not a netCDF variable" in bytes(item.attrs.get("NAME", b""))

    def variables(self, group):
        return sorted(name.rpartition("/")[2] for name in self.arrays if name.rpartition("/")[0] == group)

    def hidden(self, wrong):
        """What has the name of an axis of a group above and is not the same axis: trees hide it, or refuse the file."""
        for name, array in self.arrays.items():
            group, _, own = name.rpartition("/")
            while group:
                group = group.rpartition("/")[0]
                above = self.scales.get(group + "/" + own)
                if above is not None and not (name in self.scales and numpy.array_equal(above, array)):
                    wrong.append("%s: %s/%s, an axis above, has other values" % (name, group, own))


def by_ncdump(path, contents, wrong):
    ncdump = shutil.which("ncdump")
    if ncdump is None:
        print("ncdump: not there (Debian: netcdf-bin)")
        return
    run = subprocess.run([ncdump, "-h", path], capture_output=True, text=True, encoding="utf-8", check=False)
    wrong.check("ncdump -h: exit code", run.returncode, 0)
    wrong.check("ncdump -h: says", run.stderr, "")
    for word in ("phony", "compound", "Anonymous"):
        wrong.extend("ncdump -h: " + line.strip() for line in run.stdout.splitlines() if word in line)
    declared = re.findall(r"^\s*(?:char|byte|short|int|int64|uint\w*|float|double) (?:\\.|[^\s\\(])+ ?(?:\(.*\) )?;$",
                          run.stdout, re.MULTILINE)
    wrong.check("ncdump -h: number of variables", len(declared), len(contents.arrays))


def by_netcdf4(path, contents, wanted, wrong):
    with netCDF4.Dataset(path) as file:
        for name, values in wanted.items():
            group, variable, attribute = split(name)
            owner = file[group + "/" + variable] if variable else (file[group] if group else file)
            if attribute:
                found = owner.getncattr(attribute)
            else:
                found = owner[...]
                found = found.filled(numpy.nan) if numpy.ma.isMaskedArray(found) and found.dtype.kind == "f" else found
            wrong.check("netCDF4: " + name, texts(found), values)
        all_groups = list(groups(file))
        for group in all_groups:
            here = file[group] if group else file
            wrong.check("netCDF4: variables of %s/" % group, sorted(here.variables), contents.variables(group))
            wrong.extend("netCDF4: %s/%s: an axis without a name" % (group, d) for d in here.dimensions if "phony" in d)
        return all_groups


def by_h5netcdf(path, contents, wanted, wrong):
    with h5netcdf.File(path, "r") as file:
        for group in groups(file):
            here = file[group] if group else file
            wrong.check("h5netcdf: variables of %s/" % group, sorted(here.variables), contents.variables(group))
        for name, values in wanted.items():
            group, variable, attribute = split(name)
            owner = (file[group] if group else file)
            owner = owner.variables[variable] if variable else owner
            wrong.check("h5netcdf: " + name, texts(owner.attrs[attribute] if attribute else owner[...]), values)


def check_dataset(what, data, contents, group, wrong):
    """What holds of every group in xarray."""
    wrong.check(what + ": variables", sorted(data.variables), contents.variables(group))
    for name, variable in data.variables.items():
        # Several texts that are not all ASCII stay bytes (docs/file_formats.md).
        if variable.dtype.kind == "S" and any(byte > 127 for text in variable.values.ravel() for byte in bytes(text)):
            continue
        if variable.dtype.kind not in "ifOU":
            wrong.append("%s: %s is of type %s" % (what, name, variable.dtype))
        for label in variable.encoding.get("coordinates", "").split():
            if label not in data.coords:
                wrong.append("%s: %s, of %s, is no coordinate" % (what, label, name))
    wrong.extend("%s: axis %s has no values" % (what, d) for d in data.dims if d not in data.coords)


def check_copy(what, data, engine, wrong):
    """A dataset can be stored again; of many variables some, since h5netcdf asks all for the length of a growing axis."""
    data = data[list(data.data_vars)[:20]]
    with tempfile.TemporaryDirectory() as folder:
        try:
            data.to_netcdf(folder + "/copy.nc", engine=engine)
            with xarray.open_dataset(folder + "/copy.nc", engine=engine) as copy:
                xarray.testing.assert_equal(data, copy)
        except (TypeError, ValueError, AssertionError, h5netcdf.legacyapi.core.CompatibilityError) as error:
            wrong.append("%s: stored again: %s" % (what, str(error).strip().replace("\n", " ")[:200]))


def by_xarray(path, engine, all_groups, contents, wanted, wrong):
    found = {}
    for group in all_groups:
        what = "xarray, %s, %s/" % (engine, group)
        with warnings.catch_warnings(record=True) as said, xarray.open_dataset(path, engine=engine,
                                                                              group=group or None) as data:
            data.load()
            check_dataset(what, data, contents, group, wrong)
            check_copy(what, data, engine, wrong)
            found[group] = data
        wrong.extend("%s: warns: %s" % (what, w.message) for w in said
                     if not issubclass(w.category, (DeprecationWarning, FutureWarning)))
    for name, values in wanted.items():
        group, variable, attribute = split(name)
        if not variable and group + "/" != "/":  # "/group@attribute"
            continue
        owner = found[group][variable] if variable else found[group]
        if variable and not attribute:
            wrong.check("xarray, %s: %s" % (engine, name), texts(owner.values), values)
        else:
            wrong.check("xarray, %s: %s" % (engine, name), texts(owner.attrs[attribute]), values)
    return found


def by_tree(path, engine, found, wrong):
    """As one tree; a node may see the axes of those above, but what is its own must be as in the group alone."""
    if not hasattr(xarray, "open_datatree"):
        return False
    try:
        tree = xarray.open_datatree(path, engine=engine)
    except ValueError as error:
        wrong.append("xarray, tree, %s: %s" % (engine, str(error).splitlines()[0]))
        return True
    with tree:
        for group, data in found.items():
            node = tree[group or "/"].to_dataset()
            for name in data.variables:
                if name not in node.variables or not node[name].variable.equals(data[name].variable):
                    wrong.append("xarray, tree, %s: %s/%s has other values" % (engine, group, name))
    return True


def close(a, b):
    return (math.isnan(a) and math.isnan(b)) or abs(a - b) <= 1e-9 * max(abs(a), abs(b), 1e-3)


def against_campbell(path, branches, wrong):
    """The table that is written beside a Campbell diagram, ten digits."""
    modes = branches.set_index(branch="name")
    rpm = modes["rotor_speed"] * 30 / math.pi
    columns = {"natural_frequency": "natural_frequency", "damped_frequency": "damped_frequency",
               "damping_ratio": "damping_ratio", "mac": "mac", "growth_rate": "eigenvalue_real"}
    with open(path, encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    for row in rows:
        row = {key.partition("[")[0]: value for key, value in row.items()}
        point = int(abs(rpm - float(row["rotor_speed"])).argmin())
        mode = modes.sel(branch=row["mode"]).isel(rotor_speed=point)
        for column, variable in columns.items():
            if not close(float(row[column]), float(mode[variable])):
                wrong.append("%s, %s at %s rpm: %s, in the table %s" % (column, row["mode"], row["rotor_speed"],
                                                                       float(mode[variable]), row[column]))
        wrong.check("kind of " + row["mode"], str(mode["kind"].values), row["kind"])
    print("%d lines of the table" % len(rows))
    if not rows:
        wrong.append("%s: an empty table" % path)


def against_history(path, run, wrong):
    """The table of all channels that our program exports."""
    channels = {"time": "time", **{data.attrs["channel"]: name for name, data in run.data_vars.items()}}
    with open(path, encoding="utf-8", newline="") as lines:
        header, *rows = csv.reader(line for line in lines if not line.startswith("#"))
    table = numpy.array(rows, dtype=float)
    wrong.check("columns of the table", sorted(h.rpartition("[")[0] for h in header), sorted(channels))
    for column, title in enumerate(header):
        name, _, unit = title.rstrip("]").rpartition("[")
        data = run[channels.get(name, "time")]
        wrong.check("unit of " + name, "1" if unit == "-" else unit, data.attrs["units"])
        if not all(close(a, b) for a, b in zip(data.values, table[:, column])) or len(table) != data.size:
            wrong.append("%s: differs from the table" % name)
    print("%d channels of the table" % len(header))


def attempt(what, wrong, read):
    """What a reader cannot read at all is a finding, too."""
    try:
        return read()
    except Exception as error:  # pylint: disable=broad-except
        wrong.append("%s: %s: %s" % (what, type(error).__name__, str(error).strip().replace("\n", " ")[:200]))
        return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("--expected")
    parser.add_argument("--campbell")
    parser.add_argument("--history")
    asked = parser.parse_args()
    wanted = expected(asked.expected) if asked.expected else {}
    wrong = Findings()
    contents = Contents(asked.file, wrong)
    contents.hidden(wrong)
    by_ncdump(asked.file, contents, wrong)
    all_groups = attempt("netCDF4", wrong, lambda: by_netcdf4(asked.file, contents, wanted, wrong)) or [""]
    attempt("h5netcdf", wrong, lambda: by_h5netcdf(asked.file, contents, wanted, wrong))
    found, trees = {}, False
    for engine in ENGINES:
        found = attempt("xarray, " + engine, wrong, lambda e=engine: by_xarray(asked.file, e, all_groups, contents, wanted,
                                                                              wrong)) or {}
        trees = by_tree(asked.file, engine, found, wrong)
    if asked.campbell:
        attempt("table", wrong, lambda: against_campbell(asked.campbell, found["/branches"], wrong))
    if asked.history:
        attempt("table", wrong, lambda: against_history(asked.history, found[""], wrong))
    print("\n".join(wrong) or "%d variables in %d groups, %d expectations%s" %
          (len(contents.arrays), len(all_groups), len(wanted), "" if trees else ", xarray has no trees here"))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
