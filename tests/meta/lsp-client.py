#!/usr/bin/env python3
"""lsp-client.py -- a scripted client of `qdot --lsp`, which edits scripts at random and checks what the server says.

    lsp-client.py QDOT edits N SEED FILE...    for lsp.test
    lsp-client.py QDOT protocol | shapes | fuzz N SEED | files | commands | latency FILE...

Prints a line for each thing that is wrong, and ends with 1 then.
"""
import json
import os
import random
import re
import select
import signal
import subprocess
import sys
import tempfile
import time

WRONG = []


def wrong(text):
    WRONG.append(text)
    print("# " + text, flush=True)


class Client:
    """A server with its pipes; every answer and notification is checked for its form."""

    def __init__(self, qdot, capabilities=None, initialize=True):
        self.process = subprocess.Popen([qdot, "--lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True)
        self.id = 0
        self.notes = []
        self.buffer = b""
        if initialize:
            self.abilities = self.request("initialize", {"capabilities": capabilities or {}})["capabilities"]
            self.notify("initialized", {})

    def send_bytes(self, data):
        """Send it, and keep meanwhile what the server says: one that nobody listens to would wait, and read nothing."""
        said = self.process.stdin.fileno()
        heard = [] if self.process.stdout.closed else [self.process.stdout.fileno()]
        while data:
            readable, writable, _ = select.select(heard, [said], [])
            if readable:
                block = os.read(heard[0], 1 << 16)
                self.buffer += block
                heard = heard if block else []
            if writable:
                data = data[os.write(said, data[:select.PIPE_BUF]):]

    def send(self, message):
        body = json.dumps(message).encode()
        self.send_bytes(b"Content-Length: %d\r\n\r\n" % len(body) + body)

    def fill(self, seconds):
        if not select.select([self.process.stdout], [], [], seconds)[0]:
            raise TimeoutError("no answer within %g s" % seconds)
        block = os.read(self.process.stdout.fileno(), 1 << 16)
        if not block:
            raise EOFError("the server has ended with %s" % self.process.wait())
        self.buffer += block

    def receive(self, seconds=60):
        while b"\r\n\r\n" not in self.buffer:
            self.fill(seconds)
        header, _, rest = self.buffer.partition(b"\r\n\r\n")
        found = re.fullmatch(rb"Content-Length: (\d+)", header)
        if not found:
            raise ValueError("header %r" % header)
        length = int(found.group(1))
        self.buffer = rest
        while len(self.buffer) < length:
            self.fill(seconds)
        body, self.buffer = self.buffer[:length], self.buffer[length:]
        message = json.loads(body.decode())
        if message.get("jsonrpc") != "2.0" or ("method" not in message and ("result" in message) == ("error" in message)):
            wrong("a message of no form: %.200s" % body)
        return message

    def notify(self, method, params):
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    def ask(self, method, params):
        """The whole answer to a request."""
        self.id += 1
        self.send({"jsonrpc": "2.0", "id": self.id, "method": method, "params": params})
        return self.answer(self.id)

    def answer(self, number):
        while True:
            message = self.receive()
            if "method" not in message and message.get("id") == number:
                return message
            self.notes.append(message)

    def request(self, method, params):
        message = self.ask(method, params)
        if "error" in message:
            raise ValueError("%s: %s" % (method, message["error"]))
        return message["result"]

    def end(self):
        self.request("shutdown", None)
        self.notify("exit", None)
        return self.process.wait(timeout=20)


def units(text):
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


END = re.compile("\r\n|\n|\r")


def split(text):
    return END.split(text)


def place(text, index):
    """The place of a character of the text, as the protocol counts."""
    ends = [m.end() for m in END.finditer(text) if m.end() <= index]
    return {"line": len(ends), "character": units(text[ends[-1] if ends else 0:index])}


def index_of(text, where):
    start = ([0] + [m.end() for m in END.finditer(text)])[where["line"]]
    end = start
    while units(text[start:end]) < where["character"]:
        end += 1
    return end


def apply_edits(text, edits):
    spans = sorted(((index_of(text, e["range"]["start"]), index_of(text, e["range"]["end"]), e["newText"]) for e in edits), reverse=True)
    for start, end, new in spans:
        text = text[:start] + new + text[end:]
    return text


class Document:
    def __init__(self, client, path, text):
        self.client, self.text, self.version = client, text, 1
        self.uri = "file://" + os.path.abspath(path)
        client.notify("textDocument/didOpen", {"textDocument": {"uri": self.uri, "languageId": "qdot", "version": 1, "text": text}})

    @property
    def item(self):
        return {"textDocument": {"uri": self.uri}}

    def at(self, index):
        return {"textDocument": {"uri": self.uri}, "position": place(self.text, index)}

    def change(self, start, end, new):
        self.version += 1
        edit = {"range": {"start": place(self.text, start), "end": place(self.text, end)}, "text": new}
        self.client.notify("textDocument/didChange", {"textDocument": {"uri": self.uri, "version": self.version}, "contentChanges": [edit]})
        self.text = self.text[:start] + new + self.text[end:]

    def set(self, text):
        self.version += 1
        self.client.notify("textDocument/didChange",
                           {"textDocument": {"uri": self.uri, "version": self.version}, "contentChanges": [{"text": text}]})
        self.text = text

    def diagnostics(self):
        return self.client.request("textDocument/diagnostic", self.item)["items"]

    def close(self):
        self.client.notify("textDocument/didClose", self.item)


def check_range(text, where, what):
    lines = split(text)
    for end in (where["start"], where["end"]):
        if end["line"] >= len(lines) or end["character"] > units(lines[end["line"]]):
            wrong("%s: a range beyond the text: %s" % (what, where))
            return


PIECES = ["(", ")", "[", "]", "{", "}", "\"", "#", "\\", ";", "\n", "'", "=", "==", "..", ",", " ", "θ", "θ̇", "½ ", "²", "\U0001F600", "é",
          "coord q\n", "param m > 0\n", "x = 1\n", "run 0..5 as a\n", "check T == ", "for k = 1..3", "{ x[k] = k } for k = 1..2\n", "include \"x.lag\"\n",
          "theta'", "sin(", "f(u) = u^2\n", "set m = ", "start ", "plot ", "undo\n", "reset\n", "quit\n", "1e400", "0x", "@", "$", "\t", "\r\n",
          "sum(k, k, 1, 4)", "\u202e", "\u00a0", "remove ", "lagrangian ", "particle b mass m at (", "event e: x = 0", "data F from \"f.csv\" : t, F\n",
          "save x to \"never-written.csv\"\n", "T to \"never-written.tex\"\n", "export eom to \"never-written.c\"\n", "report to \"never-written.html\"\n"]


def edit_at_random(random_, document):
    text = document.text
    start = random_.randrange(len(text) + 1)
    end = min(len(text), start + random_.choice([0, 0, 0, 1, 1, 2, 5, 20, 100]))
    start -= text[start - 1:start + 1] == "\r\n"  # no place is within the end of a line
    end += text[end - 1:end + 1] == "\r\n"
    if random_.random() < 0.3:
        other = random_.randrange(len(text) + 1)
        new = text[other:other + random_.randrange(60)]
    else:
        new = random_.choice(PIECES) if random_.random() < 0.8 else ""
    document.change(start, end, new)


def look_at_random(random_, document):
    client, index = document.client, random_.randrange(len(document.text) + 1)
    method = random_.choice(["hover", "completion", "signatureHelp", "definition", "references", "documentHighlight", "prepareRename", "documentSymbol",
                             "foldingRange", "semanticTokens/full", "codeLens", "formatting", "rename", "codeAction"])
    params = document.at(index)
    if method == "references":
        params["context"] = {"includeDeclaration": True}
    elif method == "rename":
        params["newName"] = random_.choice(["fresh_name", "m", "theta", "sin", "2x", "", "ξ"])
    elif method == "codeAction":
        params.update(range={"start": params["position"], "end": params["position"]}, context={"diagnostics": []})
    elif method == "formatting":
        params["options"] = {"tabSize": 4, "insertSpaces": True}
    answer = client.ask("textDocument/" + method, params)
    result = answer.get("result")
    if "error" in answer and method not in ("rename", "prepareRename"):
        wrong("%s: %s" % (method, answer["error"]))
    if method in ("definition", "references", "documentHighlight", "documentSymbol", "formatting") and result is not None:
        for entry in result:
            if entry.get("uri", document.uri) == document.uri:
                check_range(document.text, entry["range"], method)
    if method == "formatting" and result:
        check_layout(document.text, apply_edits(document.text, result), "edited")
    if method == "semanticTokens/full":
        check_tokens(document.text, result["data"])
    if method == "completion":
        for entry in result["items"]:
            check_range(document.text, entry["textEdit"]["range"], method)


def check_tokens(text, data):
    lines, line, character = split(text), 0, 0
    if len(data) % 5:
        wrong("semantic tokens: %d numbers" % len(data))
    for k in range(0, len(data) - 4, 5):
        character = data[k + 1] + (0 if data[k] else character)
        line += data[k]
        if line >= len(lines) or character + data[k + 2] > units(lines[line]):
            wrong("semantic tokens beyond the text: line %d" % line)
            return


def check_layout(text, laid_out, name):
    """Nothing but blanks may differ."""
    if re.sub(r"[ \t]", "", text) != re.sub(r"[ \t]", "", laid_out):
        wrong("%s: the layout changes more than blanks" % name)


def check_formatting(document, name):
    before = document.text
    options = {"options": {"tabSize": 4, "insertSpaces": True}}
    laid_out = apply_edits(before, document.client.request("textDocument/formatting", dict(document.item, **options)))
    check_layout(before, laid_out, name)
    document.set(laid_out)
    if document.client.request("textDocument/formatting", dict(document.item, **options)):
        wrong("%s: to lay out twice is not to lay out once" % name)
    document.set(before)


def check_names(random_, document, name, most):
    """Each declared name: its definition is found; another name and back is the same text."""
    text, client = document.text, document.client
    symbols = client.request("textDocument/documentSymbol", document.item)
    if len(symbols) > most:
        symbols = random_.sample(symbols, most)
    for symbol in symbols:
        where = {"textDocument": {"uri": document.uri}, "position": symbol["selectionRange"]["start"]}
        found = client.request("textDocument/definition", where)
        if not any(f["uri"] == document.uri and f["range"] == symbol["selectionRange"] for f in found):
            wrong("%s: no definition of %s" % (name, symbol["name"]))
        answer = client.ask("textDocument/rename", dict(where, newName="zz_fresh"))
        if "error" in answer:
            print("# note: %s: %s: %s" % (name, symbol["name"], answer["error"]["message"]))
            continue
        spelled = text[index_of(text, symbol["selectionRange"]["start"]):index_of(text, symbol["selectionRange"]["end"])]
        document.set(apply_edits(text, answer["result"]["changes"][document.uri]))
        back = client.ask("textDocument/rename", dict(where, newName=spelled))
        if "error" in back and "is a word of the language" in back["error"]["message"]:
            pass  # it may be a name, but is not given to another
        elif "error" in back:
            wrong("%s: %s cannot be renamed back: %s" % (name, spelled, back["error"]["message"]))
        elif apply_edits(document.text, back["result"]["changes"][document.uri]) != text:
            wrong("%s: renaming %s back gives another text" % (name, spelled))
        document.set(text)


def run_edits(qdot, number, seed, files):
    client = Client(qdot)
    for path in files:
        name, random_ = os.path.basename(path), random.Random("%s %s" % (seed, os.path.basename(path)))
        with open(path, encoding="utf-8") as file:
            text = file.read()
        try:
            document = Document(client, path, text)
            before = document.diagnostics()
            check_formatting(document, name)
            check_names(random_, document, name, 12 if number >= 100 else 3)
            for _ in range(number):
                edit_at_random(random_, document)
                look_at_random(random_, document)
            document.set(text)
            after = document.diagnostics()
            if before != after:
                wrong("%s: other diagnostics than before: %s, %s" % (name, [b for b in before if b not in after], [a for a in after if a not in before]))
            document.close()
            client.notes.clear()
        except (EOFError, ValueError, TimeoutError, BrokenPipeError) as error:
            wrong("%s: %s" % (name, error))
            client.process.kill()
            client = Client(qdot)
    if client.end() != 0:
        wrong("the server ends with an error")


def run_protocol(qdot):
    client = Client(qdot, initialize=False)
    if client.ask("textDocument/hover", {}).get("error", {}).get("code") != -32002:
        wrong("a request before initialize")
    client.notify("textDocument/didOpen", {})
    client.request("initialize", {"capabilities": {"general": {"positionEncodings": ["utf-8", "utf-16"]}}})
    for method, params, code in [("no/such", {}, -32601), ("textDocument/hover", {}, -32602), ("textDocument/hover", None, -32602),
                                 ("textDocument/hover", [1, 2], -32602), ("initialize", {}, -32600)]:
        if client.ask(method, params).get("error", {}).get("code") != code:
            wrong("%s %s has not the error %d" % (method, params, code))
    client.send_bytes(b"Content-Length: 5\r\n\r\n{{{{{")
    if client.receive()["error"]["code"] != -32700:
        wrong("no JSON is no error")
    client.send_bytes(b"Content-Length: -3\r\n\r\n")
    if client.receive()["error"]["code"] != -32700:
        wrong("a wrong length is no error")
    text = "# é \U0001F600\ncoord θ, x\nparam m\nlagrangian m*θ'^2/2 - thta\n"
    document = Document(client, "protocol.lag", text)
    found = document.diagnostics()
    if len(found) != 1 or "unknown name `thta`" not in found[0]["message"] or found[0]["range"]["start"]["line"] != 3:
        wrong("diagnostics: %s" % found)
    if found and found[0]["range"]["start"]["character"] != len("lagrangian m*θ'^2/2 - ".encode()):
        wrong("places are not counted in bytes: %s" % found[0]["range"])
    text = "coord x\nlagrangian x'^2/2\n  f(u) = [u; 2]\nstart x = 1\nrun 0..1 as long\nvalue(long.x, 1)\nsum(k, k, 1, 3)\nparam gone\nreset\n"
    document.set(text)
    for name, line, what in [("u;", "f(u) = [u; 2]", "an argument or index"), ("long.", "run 0..1 as long", "a run or table"),
                             ("k, 1", "sum(k, k, 1, 3)", "an argument or index"), ("gone", "param gone", "a parameter")]:
        index = text.index(name)
        where = {"line": text[:index].count("\n"), "character": index - text.rfind("\n", 0, index) - 1}
        found = client.request("textDocument/hover", dict(document.item, position=where))
        if not found or found["contents"]["value"] != "```qdot\n%s\n```\n\n%s" % (line, what):
            wrong("hover of %s: %s" % (name, found))
    document.set("coord x\n" * 5000 + "x = (1\n" + "#" * 600000)
    if not document.diagnostics():
        wrong("a long text has no diagnostics")
    start = time.perf_counter()
    for long in ("coord x\n" + "y = x + 1\n" * 5000, "coord x\ny = x" + " + x" * 20000 + "\n"):
        document.set(long)
        for what in ("documentSymbol", "foldingRange", "semanticTokens/full"):
            client.request("textDocument/" + what, document.item)
        client.request("textDocument/references", dict(document.at(6), context={"includeDeclaration": True}))
    document.set("coord x\ny = x" + " + x" * 100000)
    client.request("textDocument/completion", document.at(len(document.text)))
    if time.perf_counter() - start > 20:  # 1 s; where each place is counted from the beginning, or all names are compared, 25 s
        wrong("long texts take %.1f s" % (time.perf_counter() - start))
    document.set(text)
    client.process.stdin.close()
    client.process.wait(timeout=20)
    client = Client(qdot)
    client.request("shutdown", None)
    if client.ask("textDocument/hover", {}).get("error", {}).get("code") != -32600:
        wrong("a request after shutdown")
    client.notify("exit", None)
    if client.process.wait(timeout=20) != 0:
        wrong("exit after shutdown is no success")
    client = Client(qdot)
    client.notify("exit", None)
    if client.process.wait(timeout=20) != 1:
        wrong("exit without shutdown is a success")
    client = Client(qdot)
    client.process.stdout.close()
    try:
        for _ in range(100):
            client.notify("no/such", {})
            client.send({"jsonrpc": "2.0", "id": 1, "method": "no/such"})
            time.sleep(0.002)
        wrong("a closed pipe does not end the server")
    except BrokenPipeError:
        client.process.wait(timeout=20)


# A message of each kind, to be changed.
RANGE = {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 1}}
WHOLE = {"textDocument": {"uri": "file:///a.lag"}, "position": {"line": 0, "character": 6}, "range": RANGE, "newName": "zz",
         "context": {"includeDeclaration": True, "diagnostics": []}, "options": {"tabSize": 4, "insertSpaces": True}}
OPEN = {"textDocument": {"uri": "file:///a.lag", "languageId": "qdot", "version": 1, "text": "coord x\nx\n"}}
REQUESTS = {"textDocument/" + what: WHOLE for what in [
    "diagnostic", "completion", "hover", "signatureHelp", "definition", "declaration", "references", "documentHighlight", "prepareRename", "rename",
    "documentSymbol", "formatting", "rangeFormatting", "foldingRange", "semanticTokens/full", "codeAction", "codeLens"]}
REQUESTS["workspace/executeCommand"] = {"command": "qdot.run", "arguments": ["file:///a.lag", 0]}
NOTIFICATIONS = {"textDocument/didOpen": OPEN, "textDocument/didClose": WHOLE, "textDocument/didSave": WHOLE, "$/cancelRequest": {"id": 1},
                 "textDocument/didChange": {"textDocument": {"uri": "file:///a.lag", "version": 2}, "contentChanges": [{"range": RANGE, "text": "c"}]},
                 "window/workDoneProgress/cancel": {"token": 1}, "workspace/didChangeWatchedFiles": {"changes": []}}
OTHERS = [None, True, -1, 2**31 - 1, 2**63 - 1, 1.5, "", "file://", "a\0b", "\u00e9" * 200, [], [1], {}, {"a": {}}, KeyError]


def parts_of(value, before=()):
    yield before
    for key in value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ():
        yield from parts_of(value[key], before + (key,))


def with_part(value, where, other):
    """The value with another part there; KeyError: without it."""
    if not where:
        return None if other is KeyError else other
    value = value.copy()
    if len(where) > 1 or other is not KeyError:
        value[where[0]] = with_part(value[where[0]], where[1:], other)
    else:
        del value[where[0]]
    return value


def run_shapes(qdot):
    """Every part of every message left out or replaced: each request has an answer, and none is "out of memory"."""
    client = Client(qdot)
    client.notify("textDocument/didOpen", OPEN)
    for method, params in {**REQUESTS, **NOTIFICATIONS}.items():
        for where in parts_of(params):
            for other in OTHERS:
                changed = with_part(params, where, other)
                if method in REQUESTS:
                    answer = client.ask(method, changed)
                    if answer.get("error", {}).get("code") == -32603:
                        wrong("%s %s: %s" % (method, changed, answer))
                else:
                    client.notify(method, changed)
                    client.notify("textDocument/didOpen", OPEN)
        client.notes.clear()
    for method, params in NOTIFICATIONS.items():
        if client.ask(method, params).get("error", {}).get("code") != -32600:
            wrong("%s is answered as a request" % method)
    client.notes.clear()
    client.notify("shutdown", None)  # a request without id: nothing can be answered, and nothing is done
    client.notify("textDocument/didOpen", OPEN)
    client.request("textDocument/hover", WHOLE)
    if any("method" not in note for note in client.notes):
        wrong("a request without id is answered: %s" % client.notes)
    # names that are cut in an error, within a character
    for k in range(4):
        name = "b" * k + "\U0001F600" * 200
        for method, params in [(name, None), ("textDocument/rename", dict(WHOLE, newName=name)), ("workspace/executeCommand", {"command": name})]:
            if "error" not in client.ask(method, params):
                wrong("%.40s: no error" % method)
    # half of a pair of UTF-16, bytes that are no UTF-8: the change is made
    document = Document(client, "/b.lag", "coord x\n")
    for said in (b"\\ud83d\\\\ud83d", b"\\ude00", b"\xff\xe9"):
        body = json.dumps({"jsonrpc": "2.0", "method": "textDocument/didChange", "params": {
            "textDocument": {"uri": document.uri, "version": 2}, "contentChanges": [{"text": "coord x # SAID \U0001F600\nthta"}]}}).encode().replace(b"SAID", said)
        client.send_bytes(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        if [d["message"].split("\n")[0] for d in document.diagnostics()] != ["unknown name `thta`"]:
            wrong("a change with %s is lost" % said)
        document.set("coord x\n")
    # what is offered to mend an error
    for said, expected in [("y = sin^2(x)\n", "y = sin(x)^2\n"), ("x + k\n", "param k\nx + k\n"), ("2*thet\n", None)]:
        text = "coord x\n# \U0001F600\n"
        document.set(text + said)
        where = document.diagnostics()[0]["range"]
        actions = client.request("textDocument/codeAction", dict(document.item, range=where, context={"diagnostics": []}))
        if apply_edits(document.text, actions[0]["edit"]["changes"][document.uri] if actions and expected else []) != text + (expected or said):
            wrong("%s: %s" % (said, actions))
    # packets
    client.id += 1
    body = json.dumps({"jsonrpc": "2.0", "id": client.id, "method": "textDocument/hover", "params": WHOLE}).encode()
    message = b"Content-Type: application/vscode-jsonrpc; charset=utf-8\r\nContent-Length: %d\r\n\r\n" % len(body) + body
    for k in range(len(message)):
        client.send_bytes(message[k:k + 1])
    client.answer(client.id)
    client.send_bytes(message * 3)
    for _ in range(3):
        client.answer(client.id)
    if client.end() != 0:
        wrong("the server ends with an error")


def run_files(qdot):
    """Scripts and data that a document reads: as they are being edited, and as they are on disk once closed or saved."""
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(folder + "/sub \u00fc")
        os.symlink(folder + "/sub \u00fc", folder + "/link")
        client = Client(qdot)

        def write(name, text):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)

        def expect(document, what, *messages):
            found = [d["message"] for d in document.diagnostics()]
            if len(found) != len(messages) or not all(m in f for m, f in zip(messages, found)):
                wrong("%s: %s" % (what, found))

        write("parts.lag", "param q = 3\n")
        text = "include \"../parts.lag\"\nq\n"
        for name in ("sub \u00fc", "link"):
            document = Document(client, "%s/%s/main.lag" % (folder, name), text)
            expect(document, "a script is included")
            other = Document(client, folder + "/parts.lag", "param r\n")
            expect(document, "what is being edited counts", "unknown name `q`")
            other.set("param q\n")
            found = client.request("textDocument/definition", document.at(len(text) - 2))
            if [f["uri"] for f in found] != [other.uri]:
                wrong("a definition in an open document: %s" % found)
            other.set("param r\n")
            other.close()
            expect(document, "a closed document is its file")
            found = client.request("textDocument/definition", document.at(len(text) - 2))
            if [f["uri"] for f in found] != ["file://" + folder + "/parts.lag"]:
                wrong("a definition in a file: %s" % found)
            document.close()
        document = Document(client, folder + "/late.lag", "include \"new.lag\"\nz\ndata F from \"new.csv\" : t, F\nF(1)\n")
        document.diagnostics()
        write("new.lag", "param z\n")
        write("new.csv", "t,F\n0,1\n2,3\n")
        client.notify("workspace/didChangeWatchedFiles", {"changes": []})
        expect(document, "files that are there now")
        os.remove(folder + "/new.csv")
        client.notify("textDocument/didSave", document.item)
        expect(document, "data that is gone", "new.csv")
        client.end()


def run_fuzz(qdot, number, seed):
    """Messages and headers that are cut, doubled, changed by bytes: the server answers a right one afterwards."""
    random_ = random.Random(seed)
    good = [{"jsonrpc": "2.0", "id": 7, "method": "textDocument/hover", "params": {"textDocument": {"uri": "file:///a.lag"}, "position": {"line": 0, "character": 0}}},
            {"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {"textDocument": {"uri": "file:///a.lag", "text": "coord x", "version": 1}}},
            {"jsonrpc": "2.0", "method": "textDocument/didChange", "params": {"textDocument": {"uri": "file:///a.lag", "version": 2},
             "contentChanges": [{"range": {"start": {"line": 0, "character": 1}, "end": {"line": 9, "character": 9}}, "text": "x"}]}}]
    client = Client(qdot)
    for _ in range(number):
        body = bytearray(json.dumps(random_.choice(good)).encode())
        for _ in range(random_.randrange(4)):
            where = random_.randrange(len(body))
            body[where:where + random_.choice([0, 1, 5])] = bytes(random_.randrange(256) for _ in range(random_.randrange(4)))
        message = bytearray(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        if random_.random() < 0.3:
            where = random_.randrange(20)
            message[where:where + random_.randrange(3)] = bytes(random_.randrange(256) for _ in range(random_.randrange(3)))
        client.send_bytes(bytes(message))
        while select.select([client.process.stdout], [], [], 0)[0]:
            client.fill(1)
    # a header that has lost its message may take the next ones for it: send until one is answered
    for _ in range(2000):
        client.send({"jsonrpc": "2.0", "id": "here", "method": "no/such"})
        time.sleep(0.001)
        while select.select([client.process.stdout], [], [], 0)[0]:
            client.fill(1)
        if b'"id":"here"' in client.buffer:
            break
    else:
        wrong("after wrong messages a right one has no answer")
    client.process.kill()


def run_commands(qdot):
    with tempfile.TemporaryDirectory() as folder:
        client = Client(qdot, {"window": {"workDoneProgress": True}})
        text = ("param m, L > 0, g = 9.81\ncoord theta\nparticle bob mass m at (L*sin(theta), -L*cos(theta))\ngravity (0, -g)\n"
                "set m = 1, L = 1\nstart theta = 1\nrun 0..2\nplot theta to \"figure.svg\"\nanimate to \"movie.html\"\nvalue(theta, 2)\n")
        document = Document(client, os.path.join(folder, "pendulum.lag"), text)
        document.diagnostics()
        if os.listdir(folder):
            wrong("analysis writes files: %s" % os.listdir(folder))
        lenses = client.request("textDocument/codeLens", document.item)
        if [entry["command"]["command"] for entry in lenses] != ["qdot.run", "qdot.equations", "qdot.plot", "qdot.animate"]:
            wrong("lenses: %s" % lenses)

        def execute(command, *arguments):
            return client.request("workspace/executeCommand", {"command": command, "arguments": [document.uri, *arguments]})

        equations = execute("qdot.equations")
        if "\u03b8\u0308" not in equations["text"] or not equations["latex"] or equations["error"] or "<math" not in equations["html"]:
            wrong("equations: %s" % equations)
        for command, end in (("qdot.plot", ".svg"), ("qdot.animate", ".html"), ("qdot.report", ".html")):
            result = execute(command)
            if len(result["files"]) != 1 or not result["files"][0].endswith(end) or os.path.getsize(result["files"][0]) < 500:
                wrong("%s: %s" % (command, result))
        if os.listdir(folder):
            wrong("commands write the files that the script names: %s" % os.listdir(folder))
        result = execute("qdot.run")
        if "0." not in result["text"] or result["error"] or result["status"] != 0 or not os.path.exists(os.path.join(folder, "figure.svg")):
            wrong("run: %s %s" % (result, os.listdir(folder)))
        document.set("coord x\nparticle p mass 2 at x\npotential x^2\nstart x = 1\nrun 0..3\ntable x, x' every 1.5\nprint \"<b>\"\ncheck 1 == 2\n")
        result = execute("qdot.run")
        rows = result["text"].split("\n")
        first = next((k for k, line in enumerate(rows) if re.fullmatch(" *t +x +.*", line)), None)
        if first is None or len({len(line.replace("\u0307", "")) for line in rows[first:first + 4]}) != 1:
            wrong("a table has columns of other widths: %s" % result["text"])
        if result["html"].count("<table>") != 1 or result["html"].count("<tr><td>") < 3 or "&lt;b&gt;" not in result["html"] or ".qdot" not in result["style"]:
            wrong("html: %s" % result)
        if "refuted" not in result["text"] or "refuted" not in result["html"]:
            wrong("run with a refuted check: %s" % result)
        document.set("coord x\nx + thta\n")
        result = execute("qdot.run")
        if "unknown name" not in result["error"] or result["status"] == 0:
            wrong("run with an error: %s" % result)
        document.set("coord x\nlagrangian x'^2/2 - x^4 + x^2*cos(t)\nstart x = 1\nrun 0..1e9 tol 1e-13\n")
        client.id += 1
        number = client.id
        client.send({"jsonrpc": "2.0", "id": number, "method": "workspace/executeCommand", "params": {"command": "qdot.run", "arguments": [document.uri]}})
        while not any(n.get("method") == "$/progress" and n["params"]["value"]["kind"] == "report" for n in client.notes):
            client.notes.append(client.receive())
        client.notify("$/cancelRequest", {"id": number})
        if client.answer(number).get("error", {}).get("code") != -32800:
            wrong("a run is not cancelled")
        for delay in (0, 0, 0, 0.002, 0.01):  # also before the process has begun
            numbers = [client.id + 1 + k for k in range(3)]
            client.id = numbers[-1]
            for number in numbers:
                client.send({"jsonrpc": "2.0", "id": number, "method": "workspace/executeCommand", "params": {"command": "qdot.run", "arguments": [document.uri]}})
            time.sleep(delay)
            for number in numbers:
                client.notify("$/cancelRequest", {"id": number})
            answers = {}
            while len(answers) < 3:
                message = client.receive(20)
                if "method" not in message:
                    answers[message["id"]] = message.get("error", {}).get("code")
            if answers != {number: -32800 for number in numbers}:
                wrong("runs are not cancelled: %s" % answers)
        if client.end() != 0:
            wrong("the server ends with an error")
        for way in ("exit", "close", "kill"):
            client = Client(qdot)
            document = Document(client, os.path.join(folder, "long.lag"), document.text)
            client.send({"jsonrpc": "2.0", "id": 1000, "method": "workspace/executeCommand", "params": {"command": "qdot.run", "arguments": [document.uri]}})
            client.request("textDocument/hover", document.at(0))
            children = "/proc/%d/task/%d/children" % (client.process.pid, client.process.pid)
            if way == "exit":
                client.notify("exit", None)
            elif way == "close":
                client.process.stdin.close()
            elif os.path.exists(children):
                with open(children) as file:
                    (child,) = file.read().split()
                client.process.kill()
                for _ in range(100):
                    if not os.path.exists("/proc/%s/cmdline" % child) or not open("/proc/%s/cmdline" % child).read():
                        break
                    time.sleep(0.05)
                else:
                    wrong("a run goes on without its server")
                    os.kill(int(child), signal.SIGKILL)
            else:
                client.process.kill()
            client.process.wait(timeout=20)


def run_latency(qdot, files):
    """Milliseconds from a keystroke at the end of a random line to the diagnostics."""
    client, times = Client(qdot), []
    random_ = random.Random(1)
    for path in files:
        with open(path, encoding="utf-8") as file:
            text = file.read()
        document = Document(client, path, text)
        document.diagnostics()
        ends = [m.start() for m in re.finditer("\n", text)]
        for where in random_.sample(ends, min(5, len(ends))):
            for new in ("x", ""):
                client.notes.clear()
                start = time.perf_counter()
                document.change(where, where + (0 if new else 1), new)
                while not any(n.get("method") == "textDocument/publishDiagnostics" and n["params"].get("version") == document.version for n in client.notes):
                    client.notes.append(client.receive())
                times.append((1e3*(time.perf_counter() - start), os.path.basename(path)))
                document.diagnostics()
        document.close()
    times.sort()
    print("# %d keystrokes: median %.1f ms, 90 %% %.1f ms, most %.1f ms (%s)" % (len(times), times[len(times)//2][0], times[len(times)*9//10][0], *times[-1]))
    client.end()


def main():
    qdot, what, *rest = sys.argv[1:]
    if what == "edits":
        run_edits(qdot, int(rest[0]), rest[1], rest[2:])
    elif what == "protocol":
        run_protocol(qdot)
    elif what == "fuzz":
        run_fuzz(qdot, int(rest[0]), rest[1])
    elif what == "shapes":
        run_shapes(qdot)
    elif what == "files":
        run_files(qdot)
    elif what == "commands":
        run_commands(qdot)
    elif what == "latency":
        run_latency(qdot, rest)
    sys.exit(1 if WRONG else 0)


main()
