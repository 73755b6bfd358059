"""How pictures come to all samples of their lights: step by step, and who hears of it."""

import time
import unittest

import numpy
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import VTK_DOUBLE
from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor
from soft_light import SoftLightTest
from vtksvo import vtkSVORenderPass


class TestLightSteps(SoftLightTest):
    def refine(self):
        """As often as may be; the samples before each step but the last."""
        steps = [self.svo.GetNumberOfLightSamples()]
        while self.svo.Refine():
            steps.append(self.svo.GetNumberOfLightSamples())
        return steps

    def test_an_interactive_frame_has_few_and_what_it_shows_is_refined(self):
        self.soften()
        self.svo.SetMaximumLightSamples(32)
        straight = self.picture()
        self.ball.SetPosition(0.5, 0.0, 0.0)
        self.window.SetDesiredUpdateRate(10.0)
        self.picture()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 4)
        self.ball.SetPosition(0.0, 0.0, 0.0)
        few = self.picture()
        self.window.SetDesiredUpdateRate(0.0001)
        self.assertEqual(self.refine(), [4, 8, 16])
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)
        self.assertFalse((few == straight).all())
        self.assertTrue((self.shown() == straight).all())
        self.assertFalse(self.svo.Refine())
        # While somebody interacts it stays at what it is, and nothing is said to go on.
        self.ball.SetPosition(0.5, 0.0, 0.0)
        self.window.SetDesiredUpdateRate(10.0)
        self.picture()
        self.assertFalse(self.svo.Refine())
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 4)
        self.window.SetDesiredUpdateRate(0.0001)
        self.assertTrue(self.svo.Refine())
        self.renderer.RemoveAllViewProps()
        self.window.Render()
        self.assertFalse(self.svo.Refine())  # nothing is left to be seen
        self.renderer.AddActor(self.ball)
        self.renderer.AddActor(self.ground)
        self.ball.SetPosition(0.0, 0.0, 0.0)
        self.assertTrue((self.picture() == straight).all())
        # What is refined stays, whoever asks for a frame with rays as far apart.
        self.svo.AutoAdjustSampleDistancesOff()
        self.window.SetDesiredUpdateRate(10.0)
        self.assertTrue((self.picture() == straight).all())
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)

    def test_what_is_around_begins_with_one_sample(self):
        self.svo.SetAmbientOcclusion(True)
        self.svo.SetMaximumLightSamples(8)
        straight = self.picture()
        self.ball.SetPosition(0.5, 0.0, 0.0)
        for filtered, first in (True, 1), (False, 4):
            self.svo.SetFilterLightSamples(filtered)
            self.ball.SetPosition(0.5 - self.ball.GetPosition()[0], 0.0, 0.0)
            self.window.SetDesiredUpdateRate(10.0)
            self.window.Render()
            self.assertEqual(self.svo.GetNumberOfLightSamples(), first)
            self.window.SetDesiredUpdateRate(0.0001)
            self.refine()
            self.assertEqual(self.svo.GetNumberOfLightSamples(), 8)
            if filtered:
                self.assertTrue((self.shown() == straight).all())

    def test_an_error_ends_it(self):
        self.soften()
        self.svo.SetAmbientOcclusion(True)
        counts = {}
        for traced, openGL in ((True, False), (True, True), (True, False), (False, False), (False, True)):
            vtkSVORenderPass.SetUseSVO(traced, self.ground)
            self.svo.SetBackendToOpenGL() if openGL else self.svo.SetBackendToCPU()
            self.svo.SetMaximumLightSamples(4096)
            self.svo.SetLightError(2.0)
            found = self.picture()
            count = self.svo.GetNumberOfLightSamples()
            self.assertLess(count, 4096)
            self.assertGreater(count, 4)
            self.assertEqual(counts.setdefault((traced, openGL), count), count)
            # The same, step by step.
            self.ball.SetPosition(0.5, 0.0, 0.0)
            self.window.SetDesiredUpdateRate(10.0)
            self.picture()
            self.ball.SetPosition(0.0, 0.0, 0.0)
            self.picture()
            self.window.SetDesiredUpdateRate(0.0001)
            self.assertEqual(self.refine()[-1], count // 2)
            self.assertFalse(self.svo.Refine())
            self.assertTrue((self.shown() == found).all())
            # An unchanged picture is as good as it was, another colour of what VTK draws changes no
            # share of light, and a smaller error takes more.
            self.assertTrue((self.picture() == found).all())
            if openGL:
                self.ball.GetProperty().SetColor(0.5, 0.6, 0.7)
                self.picture()
                self.ball.GetProperty().SetColor(1.0, 1.0, 1.0)
                self.assertTrue((self.picture() == found).all())
            self.assertEqual(self.svo.GetNumberOfLightSamples(), count)
            self.svo.SetLightError(1e-3)
            self.svo.SetMaximumLightSamples(2 * count)
            self.picture()
            self.assertEqual(self.svo.GetNumberOfLightSamples(), 2 * count)
            self.svo.SetLightError(0.0)
            self.ball.SetPosition(0.5, 0.0, 0.0)
            self.picture()
            self.ball.SetPosition(0.0, 0.0, 0.0)
            self.svo.SetMaximumLightSamples(count)
            self.assertTrue((self.picture() == found).all())
            self.svo.SetMaximumLightSamples(512)
            truth = self.picture()
            hit = truth.sum(axis=1) > 0
            self.assertLess(numpy.sqrt(((found - truth)[hit] ** 2).mean()), 2.0)

    def test_who_listens_hears_of_samples_and_ends_them(self):
        self.soften()
        self.ground.SetPosition(0.0, 0.0, -0.01)  # else what begins is the picture before
        straight = self.picture()
        heard, told, backends, until, change = [], [], [], [2.0], []

        @calldata_type(VTK_DOUBLE)
        def hear(caller, event, amount):
            heard.append(amount)
            told.append((amount, self.svo.GetNumberOfLightSamples() / self.svo.GetMaximumLightSamples()))
            backends.append(self.svo.GetActiveBackend())
            if change:
                change.pop()()
            if amount >= until[0]:
                self.window.SetAbortRender(True)

        self.svo.AddObserver("ProgressEvent", hear)
        for traced in True, False:
            for backend in self.svo.SetBackendToCPU, self.svo.SetBackendToOpenGL:
                vtkSVORenderPass.SetUseSVO(traced, self.ground)
                backend()
                heard.clear()
                self.ball.SetPosition(0.5, 0.0, 0.0)
                other = self.picture()
                self.assertEqual(heard, [0.125, 0.25, 0.5])
                self.assertEqual(set(backends[-3:]), {self.svo.GetBackend()})
                # The next Render() goes on where this one ended.
                heard.clear()
                until[0] = 0.25
                self.ball.SetPosition(0.0, 0.0, 0.0)
                self.picture()
                self.assertEqual(heard, [0.125, 0.25])
                self.assertEqual(self.svo.GetNumberOfLightSamples(), 8)
                until[0] = 2.0
                same = self.picture()
                self.assertEqual(heard, [0.125, 0.25, 0.25, 0.5])
                self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)
                if traced and self.svo.GetActiveBackend() == self.svo.BACKEND_CPU:
                    self.assertTrue((same == straight).all())
                # What observers change is drawn as they have left it.
                change.append(lambda: self.ball.SetPosition(0.5, 0.0, 0.0))
                self.ball.SetPosition(0.2, 0.0, 0.0)
                self.assertTrue((self.picture() == other).all())
        # So is an abort of the window's.
        self.svo.RemoveObservers("ProgressEvent")
        asked = []

        def abort(caller, event):
            asked.append(self.svo.GetNumberOfLightSamples())
            self.window.SetAbortRender(True)

        self.ball.SetPosition(0.1, 0.0, 0.0)
        self.window.AddObserver("AbortCheckEvent", abort)
        time.sleep(0.3)  # windows ask five times a second
        self.window.Render()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 4)
        self.assertGreaterEqual(len(asked), 1)
        self.window.RemoveObservers("AbortCheckEvent")
        self.window.Render()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)
        # An error ends it as soon as it does without anybody who listens.
        self.svo.SetMaximumLightSamples(4096)
        self.svo.SetLightError(1.0)
        self.svo.SetBackendToCPU()
        alone = self.picture()
        count = self.svo.GetNumberOfLightSamples()
        self.svo.AddObserver("ProgressEvent", hear)
        heard.clear()
        self.ball.SetPosition(0.0, 0.0, 0.0)
        self.picture()
        self.ball.SetPosition(0.1, 0.0, 0.0)
        self.assertTrue((self.picture() == alone).all())
        self.assertEqual(self.svo.GetNumberOfLightSamples(), count)
        self.assertGreater(len(heard), 2)
        for amount, share in told:
            self.assertEqual(amount, share)
        self.assertEqual(self.said.GetOutput(), "")

    def test_steps_without_any_light(self):
        self.renderer.RemoveAllLights()
        vtkSVORenderPass.SetUseSVO(False, self.ground)
        self.svo.SetAmbientOcclusion(True)
        for property in self.ball.GetProperty(), self.ground.GetProperty():
            property.SetAmbient(0.3)
        for backend in self.svo.SetBackendToCPU, self.svo.SetBackendToOpenGL:
            backend()
            self.ball.SetPosition(0.5, 0.0, 0.0)
            alone = self.picture()
            self.assertGreater(alone.max(), 0)
            self.ball.SetPosition(0.0, 0.0, 0.0)
            self.picture()
            lights = []
            self.svo.AddObserver("ProgressEvent",
                                 lambda *_: lights.append(self.renderer.GetLights().GetNumberOfItems()))
            self.ball.SetPosition(0.5, 0.0, 0.0)
            self.assertTrue((self.picture() == alone).all())
            self.assertGreater(len(lights), 1)
            self.assertEqual(max(lights), 0)
            self.svo.RemoveObservers("ProgressEvent")

    def test_who_receives_may_change_between_steps(self):
        self.soften()
        vtkSVORenderPass.SetUseSVO(False, self.ground)
        self.picture()
        vtkSVORenderPass.SetUseSVO(True, self.ground)
        traced = self.picture()
        vtkSVORenderPass.SetUseSVO(False, self.ground)
        self.ball.SetPosition(0.5, 0.0, 0.0)
        shadowed = self.picture()
        vtkSVORenderPass.SetReceiveShadow(False, self.ground)
        self.ball.SetPosition(0.0, 0.0, 0.0)
        self.picture()
        change = [lambda: vtkSVORenderPass.SetReceiveShadow(True, self.ground)]
        self.svo.AddObserver("ProgressEvent", lambda *_: change and change.pop()())
        self.ball.SetPosition(0.5, 0.0, 0.0)
        self.assertTrue((self.picture() == shadowed).all())
        self.assertEqual(change, [])
        self.ball.SetPosition(0.0, 0.0, 0.0)
        vtkSVORenderPass.SetUseSVO(True, self.ground)
        self.assertTrue((self.picture() == traced).all())

    def test_an_interactor_refines_while_it_has_nothing_else_to_do(self):
        self.window.SetOffScreenRendering(False)
        interactor = vtkRenderWindowInteractor()
        interactor.SetRenderWindow(self.window)
        interactor.Initialize()
        self.soften()
        self.svo.SetMaximumLightSamples(32)
        self.svo.AddObserver("ProgressEvent", lambda *_: None)  # who listens does not make it wait
        self.picture()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 4)
        done = []
        waited = interactor.CreateRepeatingTimer(50)

        def look(caller, event):
            done.append(self.svo.GetNumberOfLightSamples())
            if done[-1] == 32 or len(done) > 400:
                interactor.TerminateApp()

        interactor.AddObserver("TimerEvent", look)
        interactor.Start()
        interactor.DestroyTimer(waited)
        self.assertEqual(done[-1], 32)
        self.assertFalse(self.svo.Refine())

    def test_with_opengl_it_is_refined_to_the_same_bits(self):
        self.soften()
        self.svo.SetBackendToOpenGL()
        self.svo.SetAmbientOcclusion(True)  # by rays, and so lights are
        self.svo.SetSkyLight(True)
        straight = self.picture()
        self.assertEqual(self.svo.GetNumberOfLightSamples(), 32)
        self.ball.SetPosition(0.5, 0.0, 0.0)
        self.window.SetDesiredUpdateRate(10.0)
        self.picture()
        self.ball.SetPosition(0.0, 0.0, 0.0)
        few = self.picture()
        self.window.SetDesiredUpdateRate(0.0001)
        self.assertEqual(self.refine(), [4, 8, 16])
        self.assertFalse((few == straight).all())
        self.assertTrue((self.shown() == straight).all())
        # What VTK draws and nothing casts: its samples are taken anew where it has moved.
        vtkSVORenderPass.SetCastShadow(False, self.ball)
        self.picture()
        self.ball.SetPosition(0.3, 0.0, 0.0)
        moved = self.picture()
        self.renderer.SetPass(None)
        self.window.Finalize()
        self.renderer.SetPass(self.svo)
        self.assertTrue((self.picture() == moved).all())
        self.assertEqual(self.said.GetOutput(), "")


if __name__ == "__main__":
    unittest.main()
