"""Where a place in the scene appears in the picture: along the ray of sight, on the picture's plane. numpy, no bpy.

With pixels_to_world (properties/plane.py) turned round, the plane is z = 0 and the eye a point (or, of parallel rays,
a direction) in pixels; the ray from the eye (x, y, z, w) through a place meets z = 0 after a 3x4 matrix:

    | z  0  -x  0 |
    | 0  z  -y  0 |  of the place, the first two divided by the third
    | 0  0  -w  z |

A camera's shift, sensor and aspect move the frame over the rays, not the rays: they have no part in it.
"""

from dataclasses import dataclass

import numpy as np

ALONG = 1e-6  # rays that rise less over the plane, by sine, run along it


class OutOfSight(ValueError):
    """A place that appears nowhere in the picture."""


@dataclass(frozen=True)
class Projection:
    """From the scene onto one picture."""

    matrix: np.ndarray  # (3, 4): homogeneous; the third row gives 1 on the plane
    pixel: float  # in the scene's units

    def place(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pixels (n, 2) of places (n, 3), and how many pixels a unit of the scene is long at each (n,).

        Throws OutOfSight where a place lies behind the eye.
        """
        seen = points @ self.matrix[:, :3].T + self.matrix[:, 3]
        nearness = seen[:, 2]
        if len(points) and nearness.min() <= 0:
            raise OutOfSight("lies behind the camera; move it, or delete it")
        return seen[:, :2] / nearness[:, None], 1 / (nearness * self.pixel)


def onto_picture(pixels_to_world: np.ndarray, eye: np.ndarray | None = None) -> Projection:
    """The projection by rays from `eye` (4,): a camera's place (x, y, z, 1), or where it looks from, (x, y, z, 0).

    Without an eye the rays stand on the plane. Throws OutOfSight where they run along it.
    """
    right, down = pixels_to_world[:3, 0], pixels_to_world[:3, 1]
    if eye is None:
        eye = np.append(np.cross(right, down), 0)
    to_pixels = np.linalg.inv(pixels_to_world)
    x, y, z, w = to_pixels @ eye
    length = np.linalg.norm((x, y, z))
    if abs(z) <= ALONG * length:
        raise OutOfSight("the camera looks along the picture's plane")
    rays = np.array([[z, 0, -x, 0], [0, z, -y, 0], [0, 0, -w, z]]) / z
    return Projection(rays @ to_pixels, float(np.sqrt(np.linalg.norm(right) * np.linalg.norm(down))))
