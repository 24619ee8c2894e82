"""test_lifetime.py -- what is collected, in whatever order, is silent; so is the end of the interpreter."""
import os
import subprocess
import sys
import textwrap
import unittest

import qdot

HERE = os.path.dirname(os.path.abspath(__file__))


class Lifetime(unittest.TestCase):
    def silent(self, program, said=""):
        done = subprocess.run(
            [sys.executable, "-X", "dev", "-W", "ignore::DeprecationWarning", "-c",
             textwrap.dedent(program)],
            cwd=HERE, capture_output=True, text=True, timeout=120,
            env={**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(qdot.__file__))})
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", said))

    def test_collection_in_any_order(self):
        self.silent("""
            import gc, random
            from scenes import oscillator
            choice = random.Random(1)
            held = []
            for i in range(300):
                s = oscillator()
                members = [s, s.run("0..1"), s.derive("T"), s.run("0..1 as a")]
                if i % 3 == 0:
                    members.append(members)      # a circle, which the collector finds
                held.extend(members[:1 + i % 4])
                choice.shuffle(held)
                del held[choice.randrange(1, 20):]
                if i % 10 == 0:
                    gc.collect()
            """)

    def test_exit_while_everything_is_held(self):
        self.silent("""
            import sys
            from scenes import oscillator
            s = oscillator(); motion = s.run("0..1"); formula = s.derive("T")
            sys.held = [motion, formula]       # is still there when modules are gone
            import builtins
            builtins.held = s
            """)

    def test_exit_while_daemon_threads_run(self):
        self.silent("""
            import threading, time
            import qdot
            from scenes import LONG
            def work():
                qdot.System(LONG).run("0..1.5e7")
            for i in range(3):
                threading.Thread(target=work, daemon=True).start()
            time.sleep(0.5)
            """)

    def test_exit_from_a_signal_handler_during_a_run(self):
        self.silent("""
            import signal, sys
            import qdot
            from scenes import LONG
            signal.signal(signal.SIGALRM, lambda number, frame: sys.exit(0))
            signal.setitimer(signal.ITIMER_REAL, 0.5)
            qdot.System(LONG).run("0..1.5e7")
            """)

    def test_calls_while_the_interpreter_ends(self):
        self.silent("""
            import atexit
            @atexit.register
            def last():
                print(s.derive("T"))
            from scenes import oscillator
            s = oscillator()
            """, "1/2*x'^2\n")

    def test_a_thread_goes_on_after_the_main_module(self):
        self.silent("""
            import threading, time
            from scenes import oscillator
            s = oscillator()
            def work():
                time.sleep(0.2)
                print(s.run("0..1").summary.end)
            threading.Thread(target=work).start()
            """, "1.0\n")

    @unittest.skipUnless(hasattr(os, "fork"), "no fork")
    def test_a_forked_child_is_told(self):
        self.silent("""
            import gc, os, sys
            import qdot
            from scenes import oscillator
            s = oscillator(); motion = s.run("0..1")
            sys.stdout.flush()
            child = os.fork()
            if child == 0:
                for use in lambda: s.derive("T"), lambda: motion.summary, lambda: qdot.System():
                    try:
                        use()
                    except RuntimeError as error:
                        print("spawn" in str(error))
                del s, motion
                gc.collect()
                sys.stdout.flush()
                os._exit(0)
            print(os.waitpid(child, 0)[1], s.run("0..1").summary.end)
            """, "True\nTrue\nTrue\n0 1.0\n")

    def test_processes_that_are_spawned_have_systems_of_their_own(self):
        self.silent("""
            import multiprocessing
            import scenes
            if __name__ == "__main__":
                scenes.oscillator()
                with multiprocessing.get_context("spawn").Pool(2) as pool:
                    print([s for s in pool.map(scenes.end_of_run, [1, 2])])
            """, "[1.0, 2.0]\n")

    @unittest.skipUnless(os.path.exists("/proc/self/statm"), "no /proc")
    def test_memory_of_a_thousand_systems_is_flat(self):
        self.silent("""
            import os
            from scenes import pendulum
            def resident():
                with open("/proc/self/statm") as file:
                    return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20
            def work(n):
                for i in range(n):
                    s = pendulum()
                    s.derive("eom")
                    s.run("0..1").max("theta")
            work(200)
            before = resident()
            work(1000)
            grown = resident() - before
            assert grown < 4, f"{grown:.1f} MB more"
            """)


if __name__ == "__main__":
    unittest.main()
