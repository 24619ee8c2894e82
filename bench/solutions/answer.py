"""answer.py -- what the program said to one script: its list, the conditions of each entry, and if it is all."""
import json, re, resource, signal, subprocess, tempfile

from formula import Unreadable, names

PARTIAL = re.compile(r"there may be|may be others|may not|not all|searched|not proved|may be incomplete|no proof|"
                     r"not known|cannot be told|incomplete|starts in numbers|unproved|without proof|may be more", re.I)
NONE = re.compile(r"there (is|are) no\b|no equilibrium|no solution", re.I)
ALL = re.compile(r"holds for every value|every value|every place", re.I)


class Entry:
    """One solution: equations NAME = formula (one unknown: its value), or a relation that holds on a set."""
    def __init__(self, index, text):
        self.index, self.text = index, text
        self.equations, self.relations = [], []      # (name, formula); conditions that describe a set
        self.exists, self.stable_when = None, None
        self.stability, self.numeric, self.words = None, False, ""

    def free(self, known):
        """The integers of a family: names that nothing declares."""
        parts = [f for _, f in self.equations] + self.relations + [c for c in (self.exists,) if c]
        return sorted(set().union(*[names(p) for p in parts]) - known) if parts else []


class Answer:
    def __init__(self):
        self.entries, self.notes = [], []
        self.special = []                             # ([(parameter, formula)], the entries there; None: every value)
        self.partial = self.none = self.every = self.turns = False
        self.error, self.hint, self.crash, self.status, self.output = None, None, None, 0, ""


def split(text, at=", "):
    """Parts outside brackets."""
    parts, depth, last = [], 0, 0
    for i, c in enumerate(text):
        depth += (c in "([{") - (c in ")]}")
        if depth == 0 and text.startswith(at, i):
            parts.append(text[last:i])
            last = i + len(at)
    return parts + [text[last:]]


def _conditions(words, entry):
    """`numeric, exists when a > 0 and b > 0, stable when c > 0`."""
    entry.words = words
    for part in split(words):
        part = part.strip()
        if part.startswith("numeric"):
            entry.numeric = True
        elif re.match(r"(exists |only )?(when|if|where) ",
                      part) or part.startswith("for ") or part.startswith("exists"):
            entry.exists = re.sub(r"^(exists )?(only )?(when|if|where|for) ", "", part)
            entry.exists = re.sub(r",? *(any |every |an )?integers?( [a-z]\w*)?$", "", entry.exists).strip() or None
        elif m := re.match(r"(stability undecided|stable to first order|unstable|stable|undecided)( when (.*))?$",
                           part):
            entry.stability, entry.stable_when = m[1], m[3]


def _equation(text, unknown, entry):
    """`x = 2`, a bare value, or a set such as `-1 <= x <= 1`."""
    text = text.strip()
    m = re.match(r"([A-Za-z_]\w*(?:\[[\w, ]+\])?) = (.*)$", text)
    if m and (unknown is None or m[1] == unknown) and not re.search(r"[<>]", m[2]):
        if not m[1].startswith("lambda"):
            entry.equations.append((m[1], m[2]))
    elif re.search(r"[<>]|!=| = ", text) and not text.startswith("if("):
        entry.relations.append(text)
    elif unknown is not None:
        entry.equations.append((unknown, text))
    else:
        raise Unreadable(text)


def _special(where, sets, unknown):
    """`for a = 0 and b = 1: x = V when C, x > 0`."""
    at = [tuple(part.split(" = ", 1)) for part in where.split(" and ")]
    if sets == "every value is a solution":
        return at, None
    entries = []
    for part in split(sets):
        e = Entry(1, part)
        text, _, when = part.partition(" when ")
        e.exists = when or None
        _equation(text, unknown, e)
        entries.append(e)
    return at, entries


def run_script(program, script, *options, timeout=20):
    """The finished process; its status is 124 where it needed more than `timeout` seconds of the processor, whatever
    else the machine does, or did not end in twenty times as many."""
    with tempfile.NamedTemporaryFile("w", suffix=".lag") as f:
        f.write(script)
        f.flush()
        p = subprocess.run(["timeout", str(20 * timeout), program, *options, f.name], text=True, capture_output=True,
                           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (timeout, timeout + 5)))
    p.returncode = 124 if p.returncode == -signal.SIGXCPU else p.returncode
    return p


def ask(program, script, unknown=None, timeout=20):
    """Run a script whose last statement asks for the list."""
    said = Answer()
    p = run_script(program, script, "--json", timeout=timeout)
    said.status, said.output = p.returncode, p.stdout + p.stderr
    if p.returncode == 124:
        said.crash = f"over {timeout} s"
        return said
    if p.returncode < 0 or p.returncode > 2:
        said.crash = f"status {p.returncode}: {p.stderr.strip()[-120:]}"
        return said
    entries, pending = {}, []
    for line in p.stdout.splitlines():
        try:
            o = json.loads(line)
        except json.JSONDecodeError:
            said.crash = "no JSON: " + line[:80]
            return said
        name = o.get("name", "")
        index = re.search(r"\[(\d+)\]$", name)
        if o["kind"] == "error":
            said.error, said.hint = o["message"], o.get("hint")
        elif o["kind"] in ("expr", "number") and re.match("solve|equilibria|%\\d", name):
            plain = o.get("plain") or o.get("value") or ""
            if plain == "[]" and not index:
                if unknown is not None:
                    said.none = True
                    continue
            e = Entry(int(index[1]) if index else 1, str(plain))
            entries[e.index] = e
            e.numeric = o["kind"] == "number"
            body = e.text[1:-1] if e.text.startswith("[") and e.text.endswith("]") else e.text
            for part in split(body) if body else []:
                _equation(part, unknown, e)
        elif o["kind"] == "numbers" and re.match("solve|%\\d", name):
            for k, v in enumerate(o["values"], 1):
                e = entries[k] = Entry(k, str(v))
                e.numeric = True
                _equation(e.text, unknown, e)
        elif o["kind"] in ("text", "notice", "note", "value"):
            words = o.get("text") or o.get("message") or ""
            exists = re.match(r"\w+ = (.*) exists (when .*)$", words) if o["kind"] == "notice" else None
            special = re.match(r"for (\w+ = [^:]*): (.*)$", words) if o["kind"] == "notice" else None
            if special and unknown is not None:
                said.special.append(_special(special[1], special[2], unknown))
                continue
            if exists:
                pending.append((exists[1], exists[2]))
                continue
            if index and int(index[1]) in entries:
                _conditions(words, entries[int(index[1])])
            elif index and name.startswith("equilibria"):
                e = entries[int(index[1])] = Entry(int(index[1]), "")
                _conditions(words, e)
            elif o["kind"] == "text" or PARTIAL.search(words) or "one turn" in words:
                said.notes.append(words)
    for text, words in pending:
        for e in entries.values():                     # two entries of one text: each has its notice
            if e.text == text and not e.words:
                _conditions(words, e)
                break
    said.entries = [entries[k] for k in sorted(entries)]
    notes = " ".join(said.notes)
    said.partial = any(PARTIAL.search(words) for words in [notes] + [e.words for e in said.entries])
    if not said.partial and NONE.search(notes):
        said.none = True
    said.turns = "one turn" in notes
    if ALL.search(notes) or (said.error and ALL.search(said.error)):
        said.every = True
    if said.error and NONE.search(said.error) and not PARTIAL.search(said.error):
        said.none = True
    return said
