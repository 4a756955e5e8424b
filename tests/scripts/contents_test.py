#!/usr/bin/env python3
"""contents_test.py PROJECT: can a reader find and read every page of docs/guide, docs/reference and docs/internals?

docs/README.md must link every page. A page opens with a heading and a sentence, and has at most 250 lines; a page that
a command writes may be longer. Without PROJECT the script tests itself on small pages.
"""
import pathlib
import re
import sys
import tempfile

FOLDERS = ("guide", "reference", "internals")
GREATEST = 250  # lines
WRITTEN_BY_COMMANDS = {"reference/actions.md"}
SENTENCE = re.compile(r"^(?!```)[A-Z`\[].*\w")


def opening(lines):
    """The first line after the heading that is not empty."""
    return next((line for line in lines[1:] if line.strip()), "")


def problems(docs):
    """Returns (number of pages, list of sentences about what is wrong)."""
    listed = set(re.findall(r"\]\(([^)#]+\.md)\)", (docs / "README.md").read_text(encoding="utf-8")))
    pages = [page for folder in FOLDERS for page in sorted((docs / folder).glob("*.md"))]
    wrong = []
    for page in pages:
        name, lines = page.relative_to(docs).as_posix(), page.read_text(encoding="utf-8").splitlines()
        if name not in listed:
            wrong.append(f"docs/{name} is not in docs/README.md")
        if not lines or not lines[0].startswith("# ") or not SENTENCE.match(opening(lines)):
            wrong.append(f"docs/{name} does not open with a heading and a sentence that gives its purpose")
        if len(lines) > GREATEST and name not in WRITTEN_BY_COMMANDS:
            wrong.append(f"docs/{name} has {len(lines)} lines; split it, or shorten it to {GREATEST}")
    return len(pages), wrong


def test_itself():
    """Each row: the text of a page that docs/README.md lists or not, and the end of the sentence about it, or ""."""
    good = "# Page\n\nThis page tells something.\n"
    rows = [
        (True, good, ""),
        (False, good, "is not in docs/README.md"),
        (True, "# Page\n\n```sh\ncontort\n```\n", "gives its purpose"),
        (True, "This page has no heading.\n", "gives its purpose"),
        (True, "", "gives its purpose"),
        (True, good + "line\n" * (GREATEST - 3), ""),
        (True, good + "line\n" * (GREATEST - 2), "shorten it to 250"),
    ]
    for is_listed, text, expected in rows:
        with tempfile.TemporaryDirectory() as folder:
            docs = pathlib.Path(folder)
            (docs / "guide").mkdir()
            (docs / "README.md").write_text("[page](guide/page.md)" if is_listed else "", encoding="utf-8")
            (docs / "guide/page.md").write_text(text, encoding="utf-8")
            _, wrong = problems(docs)
            if len(wrong) != (1 if expected else 0) or not all(line.endswith(expected) for line in wrong):
                sys.exit(f"{text[:60]!r}: expected {expected!r}, got {wrong}")
    print(f"contents_test.py judges {len(rows)} pages as it should")


def main():
    if len(sys.argv) < 2:
        test_itself()
        return
    count, wrong = problems(pathlib.Path(sys.argv[1]) / "docs")
    if wrong or count == 0:
        sys.exit("\n".join(wrong) or "No page was found.")
    print(f"{count} pages are listed, open with their purpose, and have at most {GREATEST} lines")


main()
