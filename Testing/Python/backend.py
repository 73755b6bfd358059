"""The backend that the tests are run with: OpenGL where VTKSVO_TEST_BACKEND says so. VTK draws all then, nothing is traced
for the eye, and octrees answer for the light, by rays in its shaders."""

import os

import vtksvo

OPENGL = os.environ.get("VTKSVO_TEST_BACKEND") == "OpenGL"


def choose(svo):
    if OPENGL:
        svo.SetBackendToOpenGL()
        svo.SetShadowTechniqueToAutomatic()
    return svo


def new_pass():
    return choose(vtksvo.vtkSVORenderPass())


def traced(actors):
    """How many are traced for the eye."""
    return 0 if OPENGL else actors


def rasterized(actors, of):
    """How many of some are left to the rasteriser."""
    return of if OPENGL else actors
