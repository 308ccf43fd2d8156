#!/usr/bin/env python3
"""bench/lsp_requests.py CASCADE [SCRIPT…]: the processor time of requests to `cascade lsp`.

For each script, prints the time of a check (from a change of the text to its diagnostics) and of
each request, in milliseconds and in checks, and whether a request stays below 30 ms or three
checks. Each number is the mean of several requests, from the scheduler's clock of the server.
Hover, completion and the like are asked at a word in the middle of the script. "after a change"
means that the text has changed before each request, so that the script is checked again.
"""
import json
import pathlib
import re
import subprocess
import sys

REPEATS = 10
LIMIT_MS, LIMIT_CHECKS = 30, 3


class Server:
    def __init__(self, cascade):
        self.child = subprocess.Popen([cascade, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.last = 0
        self.ask("initialize", {"capabilities": {}})

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.child.stdin.write(b"Content-Length: %d\r\n\r\n%b" % (len(body), body))
        self.child.stdin.flush()

    def receive(self):
        length = int(self.child.stdout.readline().split(b":")[1])
        self.child.stdout.readline()
        return json.loads(self.child.stdout.read(length))

    def ask(self, method, params):
        self.last += 1
        self.send({"id": self.last, "method": method, "params": params})
        while True:
            message = self.receive()
            if message.get("id") == self.last:
                return message.get("result")

    def tell(self, method, params):
        self.send({"method": method, "params": params})

    def milliseconds(self):
        """The processor time of the server so far."""
        status = pathlib.Path(f"/proc/{self.child.pid}/schedstat").read_text()
        return int(status.split()[0]) / 1e6


def measure(server, path):
    text = path.read_text("utf-8")
    document = {"uri": path.resolve().as_uri()}
    server.tell("textDocument/didOpen",
                {"textDocument": {**document, "languageId": "cascade", "version": 0, "text": text}})
    server.receive()

    def change():
        # A blank at the end changes the text, but no message.
        server.tell("textDocument/didChange",
                    {"textDocument": {**document, "version": 1}, "contentChanges": [{"text": text + " "}]})

    def mean(action):
        before = server.milliseconds()
        for _ in range(REPEATS):
            action()
        return (server.milliseconds() - before) / REPEATS

    def checked():
        change()
        server.receive()

    check = mean(checked)
    words = [found.start() for found in re.finditer(r"(?m)^ *\w+(?=[:'])", text)]
    at = words[len(words) // 2] if words else 0
    at += len(text[at:]) - len(text[at:].lstrip())
    line = text.count("\n", 0, at)
    column = at - (text.rfind("\n", 0, at) + 1)
    place = {"position": {"line": line, "character": column}}
    all_of_it = {"range": {"start": {"line": 0, "character": 0}, "end": {"line": line, "character": column}}}
    requests = {
        "hover": place, "completion": place, "definition": place, "references": place, "documentHighlight": place,
        "prepareRename": place, "rename": {**place, "newName": "another_name"}, "formatting": {}, "documentSymbol": {},
        "foldingRange": {}, "semanticTokens/full": {}, "documentColor": {}, "documentLink": {},
        "codeAction": {**all_of_it, "context": {"diagnostics": []}},
    }
    print(f"{path}: {len(text)} bytes, a check {check:.2f} ms")
    for name, params in requests.items():
        def ask(method="textDocument/" + name, params=params):
            server.ask(method, {"textDocument": document, **params})

        def ask_after_change():
            change()
            ask()

        for label, action in ((name, ask), (name + " after a change", ask_after_change)):
            time = mean(action)
            verdict = "" if time < LIMIT_MS or time < LIMIT_CHECKS * check else "  SLOW"
            print(f"  {label:<36}{time:8.2f} ms{time / check:8.2f} checks{verdict}")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    scripts = [pathlib.Path(name) for name in sys.argv[2:]]
    if not scripts:
        examples = pathlib.Path(__file__).parent.parent / "examples"
        scripts = [examples / "leopard.cascade", *sorted((examples / "cells").glob("*.cascade"))[:2]]
    server = Server(sys.argv[1])
    for path in scripts:
        measure(server, path)


main()
