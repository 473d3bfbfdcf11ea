"""Runs every Python block of a document: python_snippets.py DOCUMENT FOLDER NAME=FILE... A block opens files by the
names that users know, NAME, in the current folder; here they are copies of FILE in FOLDER. Blocks that import a module
that is not there are left out, and said so. Exit code 0: all others ran; 77: none could.
"""

import contextlib
import importlib.util
import io
import os
import re
import shutil
import sys
import traceback


def blocks(document):
    """Line and text of each."""
    with open(document, encoding="utf-8") as lines:
        text = lines.read()
    for match in re.finditer(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        yield text.count("\n", 0, match.start()) + 2, match.group(1)


def missing(block):
    """The first module that is not there."""
    for line in re.findall(r"^import (.*)$", block, re.MULTILINE):
        for module in line.split(","):
            name = module.split()[0].partition(".")[0]
            if importlib.util.find_spec(name) is None:
                return name
    return None


def main(document, folder, *files):
    os.environ["MPLBACKEND"] = "Agg"
    os.makedirs(folder, exist_ok=True)
    for entry in files:
        name, _, file = entry.partition("=")
        shutil.copyfile(file, os.path.join(folder, name))
    os.chdir(folder)
    ran, failed = 0, 0
    for line, block in blocks(document):
        where = "%s:%d" % (os.path.basename(document), line)
        if absent := missing(block):
            print("%s: left out, there is no module %s" % (where, absent))
            continue
        said = io.StringIO()
        try:
            with contextlib.redirect_stdout(said):
                exec(compile("\n" * (line - 1) + block, document, "exec"), {})  # pylint: disable=exec-used
        except Exception:  # pylint: disable=broad-except
            traceback.print_exc(file=sys.stdout)
            failed += 1
        ran += 1
        print("%s: ran\n%s" % (where, said.getvalue()))
    return 1 if failed else 0 if ran else 77


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), *sys.argv[2:]))
