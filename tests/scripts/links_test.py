#!/usr/bin/env python3
"""links_test.py PROJECT: does each relative link of the root, docs/ and adapters/ lead somewhere?

A link must point at a file or folder of the project, and its anchor at a heading of the Markdown file. A code span that
holds a path below one of the project's folders, such as `docs/reference/cli.md`, must name a file or folder, too; a
path with a word in capitals is a placeholder. Fenced code is ignored. Without PROJECT the script tests itself on small
pages.
"""
import pathlib
import re
import sys
import tempfile
import unicodedata

FENCE = re.compile(r"^\s*(```|~~~)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*\s*$")
# [text](target), ![text](target "title"); and [name]: target at the beginning of a line.
INLINE = re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^\s{0,3}\[[^\]]+\]:\s+<?([^\s>]+)>?")
PATH_IN_CODE = re.compile(r"`([a-z]+)(/[\w./-]+)`")
MADE = {"build", "contort-out"}  # folders of the project that commands make
PLACEHOLDER = re.compile(r"/[A-Z]+(/|$)")
ELSEWHERE = re.compile(r"^[a-z][a-z0-9+.-]*:", re.IGNORECASE)


def lines_outside_code(text):
    """Yields (number, line) of the lines that are not in a fenced block."""
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        if FENCE.match(line):
            inside = not inside
        elif not inside:
            yield number, line


def slug(heading):
    """The anchor that GitHub gives a heading: lower case, words joined by hyphens, no punctuation."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "").lower()
    kept = [c for c in text if c in " -_" or unicodedata.category(c)[0] in "LNM"]
    return "".join(kept).replace(" ", "-")


def anchors(path):
    """All anchors of a Markdown file; the second of two equal headings ends in -1, and so on."""
    found = set()
    for _, line in lines_outside_code(path.read_text(encoding="utf-8")):
        match = HEADING.match(line)
        if match:
            base, name, repeat = slug(match.group(1)), slug(match.group(1)), 0
            while name in found:
                repeat += 1
                name = f"{base}-{repeat}"
            found.add(name)
    return found


def links(path):
    """Yields (line number, target) of each link of a Markdown file."""
    for number, line in lines_outside_code(path.read_text(encoding="utf-8")):
        for target in INLINE.findall(re.sub(r"`[^`]*`", "", line)) + REFERENCE.findall(line):
            yield number, target


def paths_in_code(project, path):
    """Yields (line number, path) of each code span that names a file or folder of the project."""
    for number, line in lines_outside_code(path.read_text(encoding="utf-8")):
        for folder, rest in PATH_IN_CODE.findall(line):
            if folder.strip("/") not in MADE and (project / folder).is_dir() and not PLACEHOLDER.search(rest):
                yield number, folder + rest


def problem(project, page, target):
    """Says what is wrong with a link of a page, or returns None."""
    name, _, anchor = target.partition("#")
    path = (page.parent / name).resolve() if name else page.resolve()
    if path != project and project not in path.parents:
        return "leads out of the project"
    if not path.exists():
        return "there is no such file"
    if anchor and path.suffix == ".md" and anchor not in anchors(path):
        return "the page has no such heading"
    return None


def pages(project):
    named = [project / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md")]
    return [page for page in named if page.exists()] + sorted(
        page for folder in ("docs", "adapters") for page in (project / folder).rglob("*.md"))


def problems(project):
    """Returns (number of links and paths, list of sentences about broken ones)."""
    project = project.resolve()
    count, broken = 0, []
    for page in pages(project):
        for number, target in links(page):
            if ELSEWHERE.match(target):
                continue
            count += 1
            reason = problem(project, page, target)
            if reason:
                broken.append(f"{page.relative_to(project)}:{number}: {target}: {reason}")
        for number, path in paths_in_code(project, page):
            count += 1
            if not (project / path).exists():
                broken.append(f"{page.relative_to(project)}:{number}: {path}: there is no such file")
    return count, broken


def test_itself():
    """Each row: the text of docs/page.md, and the reason that must be given; "" for none."""
    rows = [
        ("[a](other.md)", ""),
        ("[a](../README.md#first-steps)", ""),
        ("[a](#here-too)\n\n## Here, `too`", ""),
        ("# Twice\n# Twice\n[a](#twice-1)", ""),
        ("[a](https://example.org/x.md) and [b](mailto:a@example.org)", ""),
        ("```\n[a](nowhere.md)\n```\n`[b](nowhere.md)`", ""),
        ("[![picture](other.md)](other.md)", ""),
        ("[a](nowhere.md)", "docs/page.md:1: nowhere.md: there is no such file"),
        ("![a](nowhere.png \"title\")", "there is no such file"),
        ("\n[a](other.md#nowhere)", "docs/page.md:2: other.md#nowhere: the page has no such heading"),
        ("```\n# Code\n```\n[a](#code)", "the page has no such heading"),
        ("[a](../../etc/passwd)", "leads out of the project"),
        ("[a]: nowhere.md", "there is no such file"),
        ("`docs/other.md`, `docs/NAME/other.md` and `elsewhere/nowhere.md`", ""),
        ("`build/nowhere`", ""),
        ("`docs/nowhere.md`", "docs/page.md:1: docs/nowhere.md: there is no such file"),
    ]
    for text, expected in rows:
        with tempfile.TemporaryDirectory() as folder:
            project = pathlib.Path(folder)
            (project / "docs").mkdir()
            (project / "build").mkdir()
            (project / "README.md").write_text("# First steps\n", encoding="utf-8")
            (project / "docs/other.md").write_text("# Other\n", encoding="utf-8")
            (project / "docs/page.md").write_text(text, encoding="utf-8")
            _, broken = problems(project)
            if len(broken) != (1 if expected else 0) or not all(line.endswith(expected) for line in broken):
                sys.exit(f"{text!r}: expected {expected!r}, got {broken}")
    print(f"links_test.py judges {len(rows)} pages as it should")


def main():
    if len(sys.argv) < 2:
        test_itself()
        return
    count, broken = problems(pathlib.Path(sys.argv[1]))
    print("\n".join(broken))
    if count == 0:
        sys.exit("No link was found.")
    if broken:
        sys.exit(f"{len(broken)} of {count} links and paths lead nowhere.")
    print(f"{count} links and paths lead somewhere")


main()
