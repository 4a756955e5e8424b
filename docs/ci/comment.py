#!/usr/bin/env python3
"""comment.py FILE: puts the Markdown in FILE below the pull request of GitHub or the merge request of GitLab.

A later run changes the comment of an earlier one, which is found by the first line of FILE. The variables are those of
the two hosts, and CONTORT_TOKEN, which may write comments; on GitHub also CONTORT_REQUEST, the number of the request.
"""
import json
import os
import sys
import urllib.request

MOST_CHARACTERS = 60_000  # GitHub takes 65,536


def call(method, url, body=None):
    """Returns the JSON of the answer."""
    token = os.environ["CONTORT_TOKEN"]
    headers = {"Authorization": f"Bearer {token}", "Content-Type": "application/json", "User-Agent": "contort"}
    data = None if body is None else json.dumps({"body": body}).encode()
    with urllib.request.urlopen(urllib.request.Request(url, data, headers, method=method), timeout=30) as answer:
        return json.load(answer)


def places():
    """Returns the address of the comments, that of one comment without its id, and the method that changes one."""
    env = os.environ
    if "GITHUB_ACTIONS" in env:
        issues = f"{env['GITHUB_API_URL']}/repos/{env['GITHUB_REPOSITORY']}/issues"
        return f"{issues}/{env['CONTORT_REQUEST']}/comments", f"{issues}/comments", "PATCH"
    project = f"{env['CI_API_V4_URL']}/projects/{env['CI_PROJECT_ID']}"
    notes = f"{project}/merge_requests/{env['CI_MERGE_REQUEST_IID']}/notes"
    return notes, notes, "PUT"


def own_comment(comments, mark):
    """Returns the id of the comment that begins with the mark; None if there is none among the first thousand."""
    for page in range(1, 11):
        some = call("GET", f"{comments}?per_page=100&page={page}")
        for comment in some:
            if comment["body"].startswith(mark):
                return comment["id"]
        if len(some) < 100:
            return None
    return None


def main():
    with open(sys.argv[1], encoding="utf-8", errors="replace") as file:
        text = file.read()
    if len(text) > MOST_CHARACTERS:
        text = text[:MOST_CHARACTERS] + "\n\nThe rest is in the report.\n"
    comments, comment, change = places()
    known = own_comment(comments, text.splitlines()[0])
    if known is None:
        call("POST", comments, text)
    else:
        call(change, f"{comment}/{known}", text)


if __name__ == "__main__":
    main()
