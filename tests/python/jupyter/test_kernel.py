"""test_kernel.py -- the kernel as Jupyter's front ends talk to it."""
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import ipykernel
    import jupyter_client.kernelspec
    from jupyter_client.manager import start_new_kernel
except ImportError as missing:
    raise unittest.SkipTest(f"no {missing.name}")

try:
    import jupyter_kernel_test
except ImportError:
    jupyter_kernel_test = None

assert ipykernel
SCENE = "coord x; particle p mass 1 at (x, 0); potential x^4; start x = 1"
_folder = tempfile.TemporaryDirectory()


def setUpModule():
    """Install the kernel where only this test finds it."""
    os.environ["JUPYTER_PATH"] = os.path.join(_folder.name, "share", "jupyter")
    os.environ["JUPYTER_DATA_DIR"] = os.path.join(_folder.name, "data")
    os.environ["JUPYTER_RUNTIME_DIR"] = os.path.join(_folder.name, "runtime")
    subprocess.run(
        [sys.executable, "-m", "qdot.kernel", "install", "--prefix", _folder.name],
        check=True,
        stdout=subprocess.DEVNULL,
    )


def tearDownModule():
    _folder.cleanup()


class Installed(unittest.TestCase):
    def test_the_specification_starts_this_python(self):
        spec = jupyter_client.kernelspec.get_kernel_spec("qdot")
        folder = spec.resource_dir
        self.assertEqual(spec.argv[:3], [sys.executable, "-m", "qdot.kernel"])
        self.assertEqual((spec.language, spec.interrupt_mode), ("qdot", "signal"))
        self.assertIn("logo-svg.svg", os.listdir(folder))
        with open(os.path.join(folder, "kernel.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file)["display_name"], "qdot")

    def test_what_is_installed_can_be_removed(self):
        def kernel(*arguments):
            return subprocess.run(
                [sys.executable, "-m", "qdot.kernel", *arguments], capture_output=True, text=True
            )

        self.assertEqual(
            kernel("install", "--prefix", _folder.name, "--name", "second").returncode, 0
        )
        self.assertEqual(kernel("remove", "--name", "second").returncode, 0)
        again = kernel("remove", "--name", "second")
        self.assertEqual(again.returncode, 1)
        self.assertIn("second", again.stderr)
        self.assertNotIn("Traceback", again.stderr)
        self.assertEqual(kernel("install", "--prefix", "/proc/nowhere").returncode, 1)
        self.assertIn("install", kernel("--help").stdout)


@unittest.skipIf(jupyter_kernel_test is None, "no jupyter_kernel_test")
class Protocol(getattr(jupyter_kernel_test, "KernelTests", unittest.TestCase)):
    kernel_name = "qdot"
    language_name = "qdot"
    file_extension = ".lag"
    code_hello_world = 'print "hello, world"'
    code_stderr = "reset; param L = 1"
    completion_samples = [
        {"text": "partic", "matches": {"particle"}},
        {"text": "coord theta; sensitivi"},
    ]
    complete_code_samples = [
        "T",
        "coord x\nparticle p mass 1 at (x, 0)",
        "x = (1 +\n 2)",
        "# nothing",
    ]
    incomplete_code_samples = ["x = (1 +", "{\n  coord x", "coord x, \\"]
    code_generate_error = "nobody + 1"
    code_display_data = [
        {"code": "1/3 + 1/6", "mime": "text/latex"},
        {"code": f"reset; {SCENE}; run 0..1", "mime": "text/html"},
        {"code": "check 1 == 2", "mime": "text/html"},
    ]
    code_inspect_sample = "particle"


class Session(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.manager, cls.client = start_new_kernel(kernel_name="qdot")

    @classmethod
    def tearDownClass(cls):
        cls.client.stop_channels()
        cls.manager.shutdown_kernel(now=True)
        cls.manager.cleanup_resources()

    def run_cell(self, code, meanwhile=None, **more):
        """Carry out a cell; return the reply, and the messages that it made."""
        asked = self.client.execute(code, stop_on_error=False, **more)
        messages = []
        while True:
            message = self.client.get_iopub_msg(timeout=60)
            if message["parent_header"].get("msg_id") != asked:
                continue
            kind, content = message["msg_type"], message["content"]
            if kind == "status" and content["execution_state"] == "idle":
                break
            if kind == "status" and meanwhile is not None:
                meanwhile()
            if kind not in ("status", "execute_input"):
                messages.append((kind, content))
        return self.reply(asked), messages

    def reply(self, asked):
        while True:
            message = self.client.get_shell_msg(timeout=60)
            if message["parent_header"].get("msg_id") == asked:
                return message["content"]

    def plain(self, code):
        """Return the texts that a cell shows."""
        reply, messages = self.run_cell(code)
        self.assertEqual(reply["status"], "ok", messages)
        return [content.get("text") or content["data"]["text/plain"] for _, content in messages]

    def test_cells_share_a_session(self):
        self.assertEqual(self.plain("reset\nparam a = 1/2"), [])
        self.assertEqual(self.plain("numeric(a)"), ["numeric(a) = 0.5"])

    def test_a_cell_that_says_nothing_is_answered(self):
        for code in ("", "# only a comment", "\n\n"):
            self.assertEqual(self.plain(code), [])

    def test_a_cell_that_is_no_text_is_answered(self):
        for code in 'print "\0"', "print 1\nprint 2 # \0\nprint 3":
            reply, messages = self.run_cell(code)
            self.assertEqual(reply["status"], "error")
            self.assertIn("the text holds a NUL", reply["evalue"])
            self.assertEqual([kind for kind, _ in messages][-1], "error")
        self.assertEqual(self.reply(self.client.complete("par\0", 3))["matches"], [])
        self.assertFalse(self.reply(self.client.inspect("par\0", 2))["found"])
        self.assertEqual(self.reply(self.client.is_complete("(\0"))["status"], "invalid")
        self.assertEqual(self.plain("print 1"), ["1"])

    def test_undo_reaches_back_over_lines_and_cells(self):
        self.plain("reset; param a = 1\nset a = 2")
        self.assertEqual(self.plain("undo\nnumeric(a)")[-1], "numeric(a) = 1")

    def test_silence_is_kept(self):
        reply, messages = self.run_cell("print 1", silent=True)
        self.assertEqual((reply["status"], messages), ("ok", []))

    def test_an_error_has_place_caret_and_hint(self):
        reply, messages = self.run_cell("reset\nparam m = 1\nset n = 2\nprint 3")
        self.assertEqual((reply["status"], reply["ename"]), ("error", "Error"))
        self.assertEqual(reply["evalue"], "there is no parameter `n`")
        ((kind, content),) = messages
        self.assertEqual(kind, "error")
        self.assertIn(":3:5: error:", content["traceback"][0])
        self.assertEqual(
            content["traceback"][1:], ["  set n = 2", "      ^", "  hint: write param n = 2"]
        )

    def test_an_interrupt_stops_the_cell_and_keeps_the_session(self):
        self.plain(f"reset; {SCENE}")
        began = time.monotonic()

        def interrupt():
            time.sleep(0.5)
            self.manager.interrupt_kernel()

        reply, messages = self.run_cell("print 1\nrun 0..1.5e7\nprint 2", meanwhile=interrupt)
        self.assertEqual((reply["status"], reply["ename"]), ("error", "Interrupted"))
        self.assertLess(time.monotonic() - began, 30)
        self.assertEqual(messages[0][1]["data"]["text/plain"], "1")
        shown = [content.get("data", {}).get("text/plain") for _, content in messages]
        self.assertNotIn("2", shown)
        self.assertIn("potential x^4", self.plain("scene")[0])

    def test_completion_and_help_at_the_cursor(self):
        self.plain("reset; coord theta")
        reply = self.reply(self.client.complete("start the", 9))
        self.assertEqual(
            (reply["matches"], reply["cursor_start"], reply["cursor_end"]), (["theta"], 6, 9)
        )
        reply = self.reply(self.client.inspect("run 0..10", 1))
        self.assertTrue(reply["found"])
        self.assertIn("integrate", reply["data"]["text/plain"])
        self.plain("param g; s = g*theta^2/2")
        reply = self.reply(self.client.inspect("print s", 7))
        self.assertIn("½\u202fg\u202fθ²", reply["data"]["text/plain"])
        self.assertIn(r"\frac{1}{2} g \theta^{2}", reply["data"]["text/markdown"])
        self.assertFalse(self.reply(self.client.inspect("", 0))["found"])

    def test_history_is_kept(self):
        self.plain("print 4711")
        last = self.reply(self.client.history(hist_access_type="tail", n=1))["history"]
        self.assertEqual([text for _, _, text in last], ["print 4711"])
        found = self.reply(self.client.history(hist_access_type="search", pattern="*4711*", n=1))[
            "history"
        ]
        self.assertEqual(len(found), 1)
        session, number, _ = found[0]
        within = self.client.history(
            hist_access_type="range", session=session, start=number, stop=number + 1
        )
        self.assertEqual(len(self.reply(within)["history"]), 1)

    def test_quit_asks_the_front_end_to_leave(self):
        reply, messages = self.run_cell("print 1\nquit\nprint 2")
        self.assertEqual([payload["source"] for payload in reply["payload"]], ["ask_exit"])
        self.assertEqual([content["data"]["text/plain"] for _, content in messages], ["1"])


if __name__ == "__main__":
    unittest.main()
