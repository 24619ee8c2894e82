"""test_threads.py -- Ctrl-C, interruption, threads and progress."""
import os
import signal
import threading
import time
import unittest

import qdot
from scenes import LONG, oscillator


def later(seconds, action):
    timer = threading.Timer(seconds, action)
    timer.start()
    return timer


def ctrl_c():
    os.kill(os.getpid(), signal.SIGINT)


class Interruption(unittest.TestCase):
    def setUp(self):
        self.s = qdot.System(LONG)

    def test_ctrl_c_stops_a_run_and_keeps_the_session(self):
        start = time.monotonic()
        later(0.3, ctrl_c)
        with self.assertRaises(KeyboardInterrupt) as caught:
            self.s.run("0..1.5e7")
        self.assertLess(time.monotonic() - start, 5)
        self.assertGreater(caught.exception.motion.summary.end, 1)
        self.assertEqual(self.s.run("0..1").summary.end, 1)

    def test_ctrl_c_that_wakes_another_thread_stops_a_run(self):
        later(0.3, lambda: signal.pthread_kill(threading.get_ident(), signal.SIGINT))
        guard = later(5, self.s.interrupt)
        with self.assertRaises(KeyboardInterrupt):
            self.s.run("0..1.5e7")
        self.assertTrue(guard.is_alive())
        guard.cancel()

    def test_ctrl_c_again_and_again(self):
        signals = []

        def handler(number, frame):
            signals.append(number)
            while frame is not None and frame.f_code.co_filename != qdot.session.__file__:
                frame = frame.f_back
            if frame is not None:  # the package is at work, not the test
                raise KeyboardInterrupt

        before = signal.signal(signal.SIGINT, handler)
        timers = [later(0.2 + 0.0005 * i, ctrl_c) for i in range(40)]
        try:
            with self.assertRaises(KeyboardInterrupt):
                self.s.run("0..1.5e7")
            for timer in timers:
                timer.join()
        finally:
            signal.signal(signal.SIGINT, before)
        self.assertGreater(len(signals), 1)
        self.assertEqual(self.s.run("0..1").summary.end, 1)

    def test_answers_before_ctrl_c_are_at_the_exception(self):
        later(0.3, ctrl_c)
        with self.assertRaises(KeyboardInterrupt) as caught:
            self.s.ask("T; run 0..1.5e7", notation="plain")
        self.assertIn("x'^2", caught.exception.answers)

    def test_what_a_signal_handler_raises_stops_a_run(self):
        def handler(number, frame):
            raise TimeoutError

        before = signal.signal(signal.SIGALRM, handler)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            with self.assertRaises(TimeoutError):
                self.s.run("0..1.5e7")
        finally:
            signal.signal(signal.SIGALRM, before)

    def test_a_signal_handler_cannot_ask_what_computes(self):
        said = []

        def handler(number, frame):
            try:
                self.s.derive("T")
            except RuntimeError as error:
                said.append(str(error))
            self.s.interrupt()

        before = signal.signal(signal.SIGALRM, handler)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            with self.assertRaises(qdot.Interrupted):
                self.s.run("0..1.5e7")
        finally:
            signal.signal(signal.SIGALRM, before)
        self.assertEqual(len(said), 1)

    def test_another_thread_interrupts(self):
        later(0.3, self.s.interrupt)
        with self.assertRaises(qdot.Interrupted) as caught:
            self.s.run("0..1.5e7")
        self.assertIsNotNone(caught.exception.motion)

    def test_a_system_that_was_closed_meanwhile_is_interrupted(self):
        s, closed = self.s, []

        def close():
            s.close()
            closed.append(True)
            s.interrupt()

        later(0.3, close)
        with self.assertRaises(qdot.Interrupted):
            s.run("0..1.5e7")
        s.interrupt()
        self.assertTrue(closed)

    def test_an_interruption_concerns_one_system(self):
        other = oscillator()
        other.interrupt()
        later(0.3, self.s.interrupt)
        with self.assertRaises(qdot.Interrupted):
            self.s.run("0..1.5e7")
        self.assertEqual(other.run("0..1").summary.end, 1)


class Threads(unittest.TestCase):
    def test_threads_of_one_system_wait_for_each_other(self):
        s, found = oscillator(), []

        def work(i):
            for k in range(20):
                motion = s.run(f"0..{i + 1}")
                found.append(motion.summary.end == i + 1 and motion.min("x", 0, 0) == 1)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [True] * 80)

    def test_threads_hold_systems_of_their_own(self):
        found = []

        def work(i):
            s = qdot.System(f"param a = {i}")
            found.extend(s.number("a^2") == i * i for _ in range(50))

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [True] * 200)

    def test_motions_are_freed_while_another_thread_computes(self):
        s = qdot.System(LONG)
        motions = [s.run("0..1") for _ in range(10)]
        thread = threading.Thread(target=lambda: self.assertRaises(
            qdot.Interrupted, s.run, "0..1.5e7"))
        thread.start()
        time.sleep(0.2)
        motions.clear()
        s.interrupt()
        thread.join()
        self.assertEqual(s.run("0..1").summary.end, 1)


class Progress(unittest.TestCase):
    def test_a_hook_is_told(self):
        s, told = qdot.System(LONG), []

        def hook(what, done, left):
            told.append((what, done, left))
            if len(told) == 2:
                s.interrupt()

        s.progress(hook)
        with self.assertRaises(qdot.Interrupted):
            s.run("0..1.5e7")
        self.assertEqual(told[0][0], "run")
        self.assertTrue(0 <= told[0][1] <= told[1][1] < 0.1)
        s.progress(None)
        later(0.8, s.interrupt)
        with self.assertRaises(qdot.Interrupted):
            s.run("0..1.5e7")
        self.assertEqual(len(told), 2)

    def test_what_a_hook_raises_is_raised(self):
        s = qdot.System(LONG)

        def hook(what, done, left):
            raise LookupError("enough")

        s.progress(hook)
        with self.assertRaisesRegex(LookupError, "enough"):
            s.run("0..1.5e7")
        self.assertEqual(s.run("0..1").summary.end, 1)


if __name__ == "__main__":
    unittest.main()
