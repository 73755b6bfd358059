"""ParaView's own window: the plugin loads from PV_PLUGIN_PATH, where the first view has its settings, by the
plugin manager or by the option --plugins, and what a user clicks and types in a session is played back.
Where ffmpeg is there, pictures of the window are left to look at.

usage: TestGui.py folder of ParaView's programs
"""

import os
import subprocess
import sys
import unittest

import gui_events

PROGRAMS = sys.argv.pop(1)
PLUGIN = os.environ["VTKSVO_PLUGIN"]
OUTPUT = os.environ["VTKSVO_OUTPUT"]
SECONDS = 240


class TestGui(unittest.TestCase):
    def play(self, name, events, options=(), says=None, **variables):
        """ParaView's client in a window plays the events and ends; all their checks have passed. `says`: in the only
        message that is given; None: none is."""
        done = os.path.join(OUTPUT, name + "-done")
        if os.path.exists(done):
            os.remove(done)
        path = os.path.join(OUTPUT, name + ".xml")
        gui_events.write(path, events)
        # With this variable ParaView takes it that no one is there to answer dialogues.
        environment = dict(os.environ, VTKSVO_DONE=done, QT_QPA_PLATFORM="xcb",
                           DASHBOARD_TEST_FROM_CTEST="1", **variables)
        # Without --dr a dialogue that welcomes the user would wait for an answer.
        gui = subprocess.run(
            [os.path.join(PROGRAMS, "paraview"), "--dr", "-geometry", "1500x1050+0+0",
             *options, "--test-script=" + path, "--exit"],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            timeout=SECONDS)
        print(gui.stdout)
        results = []
        if os.path.exists(done):
            with open(done) as file:
                results = file.read().splitlines()
        for line in results:
            with self.subTest(check=line.split(": ")[0]):
                self.assertTrue(line.endswith(": passed"), line.replace(" | ", "\n"))
        self.assertEqual(gui.returncode, 0)
        self.assertEqual(len(results), gui_events.number_of_checks(events))
        messages = [line for line in gui.stdout.splitlines()
                    if any(mark in line for mark in ("ERR|", "WARN|", "critical:"))]
        self.assertEqual(len(messages), says is not None, messages)
        self.assertTrue(all(says in message for message in messages), messages)

    def test_session(self):
        self.play("session", gui_events.SESSION, PV_PLUGIN_PATH=os.path.dirname(PLUGIN))

    def test_sources(self):
        self.play("sources", gui_events.SOURCES, PV_PLUGIN_PATH=os.path.dirname(PLUGIN))

    def test_plugin_manager(self):
        self.play("plugin-manager", gui_events.load(PLUGIN) + gui_events.LATE, says="Reset Session")

    def test_plugins_option(self):
        self.play("plugins-option", gui_events.LATE,
                  ["--plugin-search-paths=" + os.path.dirname(PLUGIN),
                   "--plugins=SparseVoxelOctree"], says="Reset Session")


if __name__ == "__main__":
    unittest.main(verbosity=2)
