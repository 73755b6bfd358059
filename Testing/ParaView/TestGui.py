"""ParaView's own window: the plugin loads from PV_PLUGIN_PATH, the first view has its settings, and what a user
clicks and types in a session is played back. Where ffmpeg is there, pictures of the window are left to
look at.

usage: TestGui.py folder of ParaView's programs
"""

import os
import subprocess
import sys
import unittest

import gui_events

PROGRAMS = sys.argv.pop(1)
FOLDER = os.path.dirname(os.path.abspath(__file__))
OUTPUT = os.environ["VTKSVO_OUTPUT"]
SECONDS = 240


class TestGui(unittest.TestCase):
    def test_session(self):
        done = os.path.join(OUTPUT, "done")
        if os.path.exists(done):
            os.remove(done)
        events = os.path.join(OUTPUT, "events.xml")
        gui_events.write(events)
        # With this variable ParaView takes it that no one is there to answer dialogues.
        environment = dict(os.environ, VTKSVO_DONE=done, QT_QPA_PLATFORM="xcb",
                           DASHBOARD_TEST_FROM_CTEST="1",
                           PV_PLUGIN_PATH=os.path.dirname(os.environ["VTKSVO_PLUGIN"]))
        # Without --dr a dialogue that welcomes the user would wait for an answer.
        gui = subprocess.run(
            [os.path.join(PROGRAMS, "paraview"), "--dr", "-geometry", "1500x1050+0+0",
             "--script=" + os.path.join(FOLDER, "gui_session.py"), "--test-script=" + events,
             "--exit"],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            timeout=SECONDS)
        print(gui.stdout)
        with open(done) as file:
            results = file.read().splitlines()
        for line in results:
            with self.subTest(check=line.split(": ")[0]):
                self.assertTrue(line.endswith(": passed"), line.replace(" | ", "\n"))
        self.assertEqual(gui.returncode, 0)
        self.assertEqual(len(results), gui_events.number_of_checks())
        for message in "ERR|", "WARN|", "critical:":
            self.assertNotIn(message, gui.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
