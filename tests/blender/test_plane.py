"""Pixels of a picture and places in the scene."""

from math import radians

import importlib

import bpy
import pytest
from mathutils import Euler, Matrix, Vector
from pixels import PACKAGE

pixels_to_world = importlib.import_module(f"{PACKAGE}.properties.plane").pixels_to_world


@pytest.fixture
def plane(scene, picture):
    """The picture's plane: 8 m wide for 1280 x 800 px, its middle at its origin."""
    plane = bpy.data.objects.new("Plane", None)
    plane.empty_display_type, plane.empty_display_size = "IMAGE", 8
    plane.empty_image_offset = -0.5, -0.5
    scene.collection.objects.link(plane)
    picture.plane, picture.picture_size = plane, (1280, 800)
    return plane


@pytest.mark.parametrize(
    "pixel, place", [((640, 400), (0, 0)), ((0, 0), (-4, 2.5)), ((1280, 800), (4, -2.5)), ((0, 800), (-4, -2.5))]
)
def test_corners_lie_at_the_corners(picture, plane, pixel, place):
    world = pixels_to_world(picture) @ Vector((*pixel, 0, 1))
    assert world.xyz.to_tuple(6) == (*place, 0)


def test_the_plane_may_be_moved_turned_and_scaled(picture, plane):
    turn = Euler((radians(90), 0, radians(30))).to_matrix().to_4x4()
    plane.matrix_world = Matrix.Translation((1, 2, 3)) @ turn @ Matrix.Scale(2, 4)
    corner = pixels_to_world(picture) @ Vector((0, 0, 0, 1))
    expected = Vector((1, 2, 3)) + turn.to_3x3() @ Vector((-8, 5, 0))
    assert (corner.xyz - expected).length < 1e-5


def test_without_a_plane_it_says_so(picture):
    with pytest.raises(ValueError, match="Lake: has no plane in the scene; make it anew with Set Up in Scene"):
        pixels_to_world(picture)
