"""ParaView's own window: the plugin loads from PV_PLUGIN_PATH, the first view has its settings, and a
scripted session is traced. Where ffmpeg is there, a picture of the window is left to look at.

usage: TestGui.py folder of ParaView's programs
"""

import os
import shutil
import subprocess
import sys
import time
import unittest

PROGRAMS = sys.argv.pop(1)
FOLDER = os.path.dirname(os.path.abspath(__file__))
OUTPUT = os.environ["VTKSVO_OUTPUT"]
SECONDS = 120  # for the window to come up


class TestGui(unittest.TestCase):
    def test_session(self):
        done = os.path.join(OUTPUT, "done")
        if os.path.exists(done):
            os.remove(done)
        environment = dict(os.environ, VTKSVO_DONE=done, QT_QPA_PLATFORM="xcb",
                           PV_PLUGIN_PATH=os.path.dirname(os.environ["VTKSVO_PLUGIN"]))
        log = os.path.join(OUTPUT, "log.txt")
        # Without --dr a dialogue that welcomes the user would wait for an answer.
        with open(log, "w") as file:
            gui = subprocess.Popen(
                [os.path.join(PROGRAMS, "paraview"), "--dr", "-geometry", "1500x1050+0+0",
                 "--script=" + os.path.join(FOLDER, "gui_session.py")],
                env=environment, stdout=file, stderr=subprocess.STDOUT)
        try:
            end = time.monotonic() + SECONDS
            while not (os.path.exists(done) and os.path.getsize(done)):
                self.assertIsNone(gui.poll(), "ParaView ended by itself; see " + log)
                self.assertLess(time.monotonic(), end, "the session is not done; see " + log)
                time.sleep(0.5)
            with open(done) as file:
                self.assertEqual(file.read().split(), ["2"])  # traced surfaces
            if shutil.which("ffmpeg"):
                time.sleep(3)  # the window's other parts
                subprocess.run(
                    ["ffmpeg", "-y", "-loglevel", "error", "-nostdin", "-f", "x11grab",
                     "-video_size", "1500x1050", "-i", os.environ["DISPLAY"], "-frames:v", "1",
                     os.path.join(OUTPUT, "window.png")], check=True)
            self.assertIsNone(gui.poll(), "ParaView ended by itself; see " + log)
        finally:
            gui.terminate()
            gui.wait()
        with open(log) as file:
            said = file.read()
        self.assertNotIn("ERR|", said)
        self.assertNotIn("WARN|", said)


if __name__ == "__main__":
    unittest.main(verbosity=2)
