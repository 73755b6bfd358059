"""interactive.py: a recorded sequence of keys does what the help text says."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
import interactive  # noqa: E402


class TestInteractive(unittest.TestCase):
    def setUp(self):
        self.room = interactive.Room(interactive.stand_ins(), offscreen=True)
        self.room.window.SetSize(160, 90)
        self.room.draw()

    def tearDown(self):
        self.room.window.Finalize()

    def press(self, *keys):
        for key in keys:
            self.room.interactor.SetKeyEventInformation(0, 0, "\0", 0, key)
            self.room.interactor.InvokeEvent("KeyPressEvent")

    def test_tab_selects_one_after_the_other(self):
        self.press("Tab")
        self.assertEqual(self.room.selected, 1)
        self.press("Tab", "Tab")
        self.assertEqual(self.room.selected, 0)

    def test_arrows_move_the_selected_object_only(self):
        before = [thing.actor.GetPosition() for thing in self.room.things]
        self.press("Tab", "Right", "Right", "Left", "Up")
        after = [thing.actor.GetPosition() for thing in self.room.things]
        self.assertEqual(after[0], before[0])
        self.assertEqual(after[2], before[2])
        self.assertAlmostEqual(after[1][0] - before[1][0], interactive.STEP)
        self.assertAlmostEqual(after[1][1] - before[1][1], interactive.STEP)
        self.assertAlmostEqual(after[1][2], before[1][2])

    def test_comma_and_period_turn(self):
        self.press("comma", "comma", "comma", "period")
        self.assertAlmostEqual(
            self.room.things[0].actor.GetOrientation()[2], 2 * interactive.TURN, places=6)

    def test_space_spins_at_each_tick_until_pressed_again(self):
        self.press("space")
        for _ in range(5):
            self.room.interactor.InvokeEvent("TimerEvent")
        self.press("space")
        self.room.interactor.InvokeEvent("TimerEvent")
        self.assertAlmostEqual(
            self.room.things[0].actor.GetOrientation()[2], 5 * interactive.SPIN, places=6)
        self.assertAlmostEqual(self.room.things[1].actor.GetOrientation()[2], 0)

    def test_s_toggles_shadows(self):
        self.press("s")
        self.assertEqual(self.room.svo.GetShadowTechnique(), self.room.svo.SHADOW_NONE)
        self.assertEqual(self.room.svo.GetNumberOfShadowRays(), 0)
        self.press("s")
        self.assertEqual(self.room.svo.GetShadowTechnique(), self.room.svo.SHADOW_BUFFER)
        self.assertGreater(self.room.svo.GetNumberOfShadowRays(), 0)

    def test_i_shows_statistics_and_h_hides_the_help(self):
        self.press("i", "h")
        self.assertTrue(self.room.statistics.GetVisibility())
        self.assertIn("primary rays", self.room.statistics.GetInput())
        self.assertFalse(self.room.help.GetVisibility())

    def test_every_key_is_in_the_help(self):
        for name in "Tab", "arrows", ", and .", "Space", "s ", "i ", "h ", "q ":
            self.assertIn(name, interactive.HELP)

    def test_other_keys_do_nothing(self):
        before = [thing.actor.GetPosition() for thing in self.room.things]
        self.press("w", "F1", "Return")
        self.assertEqual([thing.actor.GetPosition() for thing in self.room.things], before)


if __name__ == "__main__":
    unittest.main()
