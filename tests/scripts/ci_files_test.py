#!/usr/bin/env python3
"""ci_files_test.py PROJECT CONTORT: do the steps of docs/ci/action.yml and docs/ci/gitlab_package.yml work?

The steps run in bash, one after the other, with the real program and a generator that has a fault. apt-get and curl are
replaced by programs that write down how they were called, and a server on this machine takes the comments. Exit code 77
where Python has no yaml.
"""
import http.server
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading

try:
    import yaml
except ImportError:
    print("skipped: python3 has no yaml")
    sys.exit(77)


class Comments(http.server.BaseHTTPRequestHandler):
    """The comments of one request, as both hosts answer: a list, and one comment after it was written."""

    def answer(self, value):
        data = json.dumps(value).encode()
        self.send_response(200)
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def body(self):
        assert self.headers["Authorization"] == "Bearer secret", self.headers
        return json.loads(self.rfile.read(int(self.headers["Content-Length"])))["body"]

    def do_GET(self):
        if self.path.split("?")[0] != self.server.comments:
            self.send_error(404)
            return
        self.answer([{"id": key, "body": body} for key, body in self.server.texts.items()])

    def do_POST(self):
        assert self.path == self.server.comments, self.path
        self.server.texts[len(self.server.texts) + 1] = self.body()
        self.server.calls.append("POST")
        self.answer({})

    def change(self):
        folder, key = self.path.rsplit("/", 1)
        assert folder == self.server.comment and int(key) in self.server.texts, self.path
        self.server.texts[int(key)] = self.body()
        self.server.calls.append(self.command)
        self.answer({})

    do_PATCH = do_PUT = change

    def log_message(self, *_):
        pass


class Machine:
    """A folder with a repository, and what a host sets before it starts a step."""

    def __init__(self, folder, project, contort, comments, comment):
        self.folder = pathlib.Path(folder)
        bin_folder = self.folder / "bin"
        bin_folder.mkdir()
        (bin_folder / "contort").symlink_to(contort)
        for tool in ("apt-get", "curl", "sudo"):
            (bin_folder / tool).write_text(f'#!/bin/sh\necho {tool} "$@" >>"{self.folder}/calls"\n')
            (bin_folder / tool).chmod(0o755)
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Comments)
        self.server.comments, self.server.comment = comments, comment
        self.server.texts, self.server.calls = {1: "Looks good"}, []
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.generator = f"python3 {project}/adapters/python/walker.py"
        kept = {name: os.environ[name] for name in ("HOME", "LANG", "ASAN_OPTIONS") if name in os.environ}
        self.env = {**kept, "PATH": f"{bin_folder}:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}
        self.address = f"http://127.0.0.1:{self.server.server_port}"

    def run(self, text, env=None):
        """Returns the exit code of a step, as both hosts run it."""
        done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", text], cwd=self.folder, text=True,
                              env={**self.env, **(env or {})}, capture_output=True, check=False)
        self.output = done.stdout + done.stderr
        return done.returncode

    def expect(self, code, want):
        if code != want:
            sys.exit(f"exit code {code}, expected {want}:\n{self.output}")


def check_comment(server, change):
    """One comment of ours beside that of a person, written once and changed once."""
    assert server.calls == ["POST", change], server.calls
    assert sorted(server.texts) == [1, 2] and server.texts[1] == "Looks good", server.texts
    text = server.texts[2]
    assert text.startswith("<!-- contort-causes -->\n") and "Elbow leaves its range" in text, text


def try_github(folder, project, contort):
    machine = Machine(folder, project, contort, "/repos/a/b/issues/7/comments", "/repos/a/b/issues/comments")
    with open(project / "docs/ci/action.yml", encoding="utf-8") as file:
        steps = {step["name"]: step for step in yaml.safe_load(file)["runs"]["steps"]}
    machine.env.update(
        RUNNER_TEMP=str(folder), GITHUB_ACTION_PATH=str(project / "docs/ci"), GITHUB_RUN_NUMBER="3", GITHUB_SHA="1a2b",
        GITHUB_STEP_SUMMARY=str(folder / "summary.md"), GITHUB_ACTIONS="true", GITHUB_API_URL=machine.address,
        GITHUB_REPOSITORY="a/b", GENERATOR=machine.generator, CONTORT_TIME="2s", CONTORT_TOKEN="secret",
        CONTORT_REQUEST="7", PACKAGE="https://example.org/contort.deb")

    def step(name, want, **env):
        assert set(steps[name].get("env", {})) <= set(machine.env), steps[name]
        machine.expect(machine.run(steps[name]["run"], env), want)

    step("Install", 0)
    calls = (folder / "calls").read_text()
    assert f"-o {folder}/contort.deb https://example.org/contort.deb" in calls, calls
    assert f"apt-get install -y {folder}/contort.deb" in calls, calls
    step("Judge the change", 1)  # without a corpus all is new
    step("Comment", 0)
    assert "Elbow leaves its range" in (folder / "summary.md").read_text()
    step("Comment", 0)
    check_comment(machine.server, "PATCH")
    step("Comment", 0, CONTORT_REQUEST="8")  # the server does not know this one; that is no reason to fail
    assert "::warning::" in machine.output
    step("Look for more", 0)
    subprocess.run(["rm", "-r", folder / "contort-found", folder / "report"], check=True)
    step("Judge the change", 0)  # the corpus has it
    step("Judge the change", 1, GENERATOR="nobody-has-this-program")  # what cannot be judged must not pass


def try_gitlab(folder, project, contort):
    notes = "/projects/5/merge_requests/7/notes"
    machine = Machine(folder, project, contort, notes, notes)
    with open(project / "docs/ci/gitlab_package.yml", encoding="utf-8") as file:
        jobs = yaml.safe_load(file)
    (folder / "ci").symlink_to(project / "docs/ci")
    machine.env.update(
        CI_API_V4_URL=machine.address, CI_PROJECT_ID="5", CI_MERGE_REQUEST_IID="7", CI_PIPELINE_IID="3",
        CI_COMMIT_SHA="1a2b", CONTORT_PACKAGE="https://example.org/contort.deb", CONTORT_GENERATOR=machine.generator,
        CONTORT_TIME="2s", CONTORT_TOKEN="secret")

    def job(name, want, **env):
        lines = jobs[".contort-package"]["before_script"] + jobs[name]["script"]
        machine.expect(machine.run("\n".join(lines), env), want)

    job("contort:judge", 1)
    assert "apt-get install -y ./contort.deb" in (folder / "calls").read_text()
    subprocess.run(["rm", "-r", folder / "contort-found", folder / "report"], check=True)
    job("contort:judge", 1)
    check_comment(machine.server, "PUT")
    job("contort:look-for-more", 0)
    subprocess.run(["rm", "-r", folder / "contort-found", folder / "report"], check=True)
    job("contort:judge", 0, CONTORT_TOKEN="")
    assert machine.server.calls == ["POST", "PUT"], "without a token there is no comment"


def main():
    project, contort = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    for attempt in (try_github, try_gitlab):
        with tempfile.TemporaryDirectory() as folder:
            attempt(pathlib.Path(folder), project, contort)
    print("the steps for GitHub and GitLab judge, comment and keep their corpus")


if __name__ == "__main__":
    main()
