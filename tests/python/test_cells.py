"""test_cells.py -- the statements of a cell are answered one after the other, in their lines."""
import os
import tempfile
import time
import unittest

import qdot
from qdot.cells import Progress, carry_out, pieces
from qdot.kernel.history import History
from scenes import LONG


def shown(system, code):
    return [
        (o.kind, o.text) for o in carry_out(system, code, "In[1]", Progress(lambda *drawn: None))
    ]


class Pieces(unittest.TestCase):
    def test_a_piece_is_a_whole_statement_in_its_lines(self):
        self.assertEqual(
            list(pieces("a\n\n# b\nc = (1 +\n 2)\nd \\\n e\n")),
            ["a", "\n\n\nc = (1 +\n 2)", "\n\n\n\n\nd \\\n e"],
        )

    def test_a_block_is_one_piece(self):
        block = "{\n  x = 1\n  y = 2\n} for k = 1..2"
        self.assertEqual(list(pieces(block)), [block])

    def test_what_is_never_closed_is_a_piece(self):
        self.assertEqual(list(pieces("a\nb = (1\nc")), ["a", "\nb = (1\nc"])

    def test_nothing_to_say_is_nothing_to_do(self):
        for code in ("", "\n\n", "# a comment", "  # one\n\n# two"):
            self.assertEqual(list(pieces(code)), [])


class Kept(unittest.TestCase):
    def test_cells_behind_a_broken_line_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "history")
            for line in '[1, 1, "a"]', '[1, 2, "b', "7", '[1, 2]', "\xff\xfe", '[2, 1, "c"]':
                with open(path, "ab") as file:
                    file.write(line.encode("latin-1") + b"\n")
            kept = History(path)
            self.assertEqual(kept.tail(9), [(1, 1, "a"), (2, 1, "c")])
            self.assertEqual(kept.session, 3)

    def test_the_file_does_not_grow_for_ever(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "history")
            one = History(path)
            for i in range(2500):
                one.add(i, f"cell {i}")
            other = History(path)
            self.assertEqual([text for _, _, text in other.tail(1)], ["cell 2499"])
            one.add(2500, "last")  # by a session that began before
            with open(path, encoding="utf-8") as file:
                self.assertEqual(len(file.readlines()), 1001)
            self.assertEqual(History(path).tail(1)[0][2], "last")
            self.assertEqual(os.listdir(folder), ["history"])


class CarryOut(unittest.TestCase):
    def test_answers_come_before_the_next_line_is_begun(self):
        answers = carry_out(qdot.System(), "1/3\n1/0", "In[1]", Progress(lambda *drawn: None))
        self.assertEqual(next(answers).text, "⅓")
        self.assertEqual(next(answers).kind, "error")
        self.assertRaises(StopIteration, next, answers)

    def test_an_error_is_in_its_line_and_ends_the_cell(self):
        said = shown(qdot.System(), "# one\nparam m = 1\n\nset n = 2\nprint 3")
        self.assertEqual([kind for kind, _ in said], ["error"])
        self.assertEqual(
            said[0][1].split("\n")[:3],
            ["In[1]:4:5: error: there is no parameter `n`", "  set n = 2", "      ^"],
        )

    def test_the_caret_stands_below_the_place_behind_greek_letters(self):
        ((_, text),) = shown(qdot.System(), "coord θ; θ + y")
        line, caret = text.split("\n")[1:3]
        self.assertEqual(line[caret.index("^")], "y")

    def test_a_bar_is_drawn_again_in_its_place_and_says_how_it_ended(self):
        drawn = []
        bar = Progress(lambda data, name, again: drawn.append((data["text/plain"], name, again)))
        bar.report("run 0..1", 0.1, 1.0)
        self.assertEqual(drawn, [])  # it may be done in a moment
        bar._began -= 10
        bar.report("run 0..1", 0.5, None)
        bar.report("run 0..1", 0.5, 3.0)  # too soon after the last
        time.sleep(0.25)
        bar.report("run 0..1", 0.75, 3.0)
        bar.end("done")
        bar.end("done")
        self.assertEqual([again for _, _, again in drawn], [False, True, True])
        self.assertEqual(len({name for _, name, _ in drawn}), 1)
        self.assertIn("75%, 3 s left", drawn[1][0])
        self.assertRegex(drawn[2][0], r"run 0\.\.1: done after 10\.\d s")

    def test_a_hook_of_ones_own_is_there_behind_the_cell(self):
        system, told = qdot.System(LONG), []

        def hook(what, done, left):
            told.append(what)
            system.interrupt()

        self.assertIsNone(system.progress(hook))
        shown(system, "T\nnothing")
        self.assertRaises(qdot.Interrupted, system.run, "0..1.5e7")
        self.assertEqual(told[:1], ["run"])
        self.assertIs(system.progress(None), hook)

    def test_a_long_run_reports_its_progress(self):
        drawn, system = [], qdot.System(LONG)

        def draw(data, name, again):
            drawn.append(data["text/plain"])
            system.interrupt()

        list(carry_out(system, "run 0..1.5e7", "In[1]", Progress(draw)))
        self.assertGreaterEqual(len(drawn), 2)


if __name__ == "__main__":
    unittest.main()
