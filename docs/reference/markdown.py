#!/usr/bin/env python3
"""Reads a document in GitHub's Markdown, writes it in Doxygen's.

usage: markdown.py <document>

Translated are formulas ($...$, $$...$$, ```math), drawings (```mermaid flowcharts), emphasis (Doxygen's own ends at links
and formulas), the names of headings, and links to documents, headers and rooms. Of a link to anything else in the tree
the path is left: the site has no page of it.
"""
import os
import re
import sys

SOURCE = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
BLOCK = re.compile(r"^ *```(\w*)\n(.*?)^ *```\n", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^(#+) (.*)$", re.MULTILINE)
LITERAL = re.compile(r"`[^`]+`|\$\$[^$]+\$\$|\$[^$]+\$")
STRONG = re.compile(r"\*\*(?=\S)([^*]+)(?<=\S)\*\*")
EMPHASIS = re.compile(r"\*(?=\S)((?:(?!\n\n)[^*])+)(?<=\S)\*")
LINK = re.compile(r"(?<!!)\[([^][]+)\]\((?!https?:)([^)]+)\)")


def read(document):
    with open(document, encoding="utf-8") as file:
        return file.read()


def heading_names(document):
    """The names GitHub gives to the headings of a document, in their order."""
    names = []
    for _, heading in HEADING.findall(BLOCK.sub("", read(document))):
        name = base = re.sub(r"[^\w\- ]", "", LINK.sub(r"\1", heading).lower()).replace(" ", "-")
        count = 0
        while name in names:
            count += 1
            name = f"{base}-{count}"
        names.append(name)
    return names


def label(document, heading=""):
    """Name of a page or a heading within the whole site."""
    page = os.path.splitext(os.path.basename(document))[0].lower()
    return f"{page}-{heading}" if heading else page


def link(text, target, document):
    text = text.replace("\n", " ")
    path, _, heading = target.partition("#")
    file = os.path.normpath(os.path.join(os.path.dirname(document), path)) if path else document
    name = os.path.relpath(file, SOURCE)
    if not os.path.exists(file) or (heading and heading not in heading_names(file)):
        sys.exit(f"{document}: link to {target}, which there is not")
    if name == "README.md" and not heading:
        return f'@ref index "{text}"'
    if name.endswith(".md"):
        if heading == heading_names(file)[0]:
            heading = ""
        return f'@ref {label(file, heading)} "{text}"'
    if re.match("(mbs|elements|solvers|turbines)/", name) and not re.search("/(detail|registers)\\b", name):
        if name.endswith(".hpp"):
            return f'@ref {name} "{text}"'
        if os.path.isdir(file):
            return f'@ref room-{name.replace("/", "-")} "{text}"'
    return text if name in text else f"{text} (`{name}`)"


def translate_literal(text):
    """Code, and formulas in a line or displayed."""
    if text.startswith("`"):
        return text
    if text.startswith("$$"):
        return f"\\f[{text[2:-2]}\\f]"
    return f"\\f{text[:-1]}\\f$"


def translate_prose(text, document, names):
    """Text between blocks. `names`: iterator over the names of headings, the title's first."""

    def heading(found):
        if "$" in found[2]:
            sys.exit(f"{document}: formula in the heading {found[2]}, which the reference shows as it is typed")
        name = next(names)
        return f"{found[0]} {{#{label(document, name if len(found[1]) > 1 else '')}}}"

    text = HEADING.sub(heading, text)
    literals = [translate_literal(literal) for literal in LITERAL.findall(text)]
    text = LITERAL.sub("\0", text)
    text = LINK.sub(lambda found: link(found[1], found[2], document), text)
    text = EMPHASIS.sub(r"<em>\1</em>", STRONG.sub(r"<b>\1</b>", text))
    return re.sub("\0", lambda _: literals.pop(0), text)


def translate_block(language, text):
    if language == "math":
        return f"\\f[\n{text}\\f]\n"
    if language == "mermaid":
        text = re.sub(r"flowchart (\w+)", r"digraph { rankdir=\1; size=9; node [shape=box]", text)
        text = re.sub(r"(\S+) --> (\S+)", r'"\1" -> "\2"', text)
        return f"@dot\n{text}}}\n@enddot\n"
    return f"```{language}\n{text}```\n"


def translate(document):
    text = read(document)
    names = iter(heading_names(document))
    end = 0
    for block in BLOCK.finditer(text):
        yield translate_prose(text[end : block.start()], document, names)
        yield translate_block(block[1], block[2])
        end = block.end()
    yield translate_prose(text[end:], document, names)


sys.stdout.reconfigure(encoding="utf-8")
print("".join(translate(os.path.abspath(sys.argv[1]))))
