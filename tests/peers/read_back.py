"""Reads a file of ours with netCDF4 and with xarray (by netCDF4 and by h5netcdf) and holds what they find against what
was written: read_back.py FILE EXPECTED. A line of EXPECTED is the path of a variable or, with @, of an attribute, and
its values in order, separated by tabulators; numbers have 17 digits. Every group must open in xarray, and no axis may
be without a name of ours. Exit code 0: all of it holds.
"""

import sys

import netCDF4
import numpy
import xarray


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


def check(what, found, wanted, wrong):
    if found != wanted:
        wrong.append("%s: %s for %s" % (what, found[:5], wanted[:5]))


def by_netcdf4(path, wanted, wrong):
    with netCDF4.Dataset(path) as file:
        for name, values in wanted.items():
            if "@" in name:
                owner, attribute = name.split("@")
                found = (file[owner] if owner != "/" else file).getncattr(attribute)
            else:
                found = file[name][...]
                found = found.filled(numpy.nan) if numpy.ma.isMaskedArray(found) and found.dtype.kind == "f" else found
            check("netCDF4: " + name, texts(found), values, wrong)
        return list(groups(file))


def by_xarray(path, engine, all_groups, wanted, wrong):
    for group in all_groups:
        with xarray.open_dataset(path, engine=engine, group=group or None, decode_times=False) as data:
            for dimension in data.dims:
                if "phony" in dimension:
                    wrong.append("%s: %s: an axis without a name" % (engine, group))
            for name, values in wanted.items():
                owner, _, variable = name.partition("@")[0].rpartition("/")
                if "@" in name and owner + "/" + variable == (group or "/"):
                    check(engine + ": " + name, texts(data.attrs[name.partition("@")[2]]), values, wrong)
                elif owner == group and "@" in name:
                    check(engine + ": " + name, texts(data[variable].attrs[name.partition("@")[2]]), values, wrong)
                elif owner == group:
                    check(engine + ": " + name, texts(data[variable].values), values, wrong)


def main(path, lines):
    wanted, wrong = expected(lines), []
    all_groups = by_netcdf4(path, wanted, wrong)
    for engine in ("netcdf4", "h5netcdf"):
        by_xarray(path, engine, all_groups, wanted, wrong)
    print("\n".join(wrong) or "%d variables and attributes in %d groups" % (len(wanted), len(all_groups)))
    return 1 if wrong or not wanted else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
