"""The dicts that the package gives. Arrays are read-only; n particles, pairs are (x, y)."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Particles(TypedDict):
    """Particles of one instant, in the order of their identity."""

    position: NDArray[np.float64]
    """(n, 2) [m]."""
    velocity: NDArray[np.float64]
    """(n, 2) [m/s]."""
    pressure: NDArray[np.float64]
    """(n) [Pa]."""
    density: NDArray[np.float64]
    """(n) [kg/m³]."""
    spacing: NDArray[np.float64]
    """(n) √(m/ρ) [m]."""


class LoggedParticles(Particles):
    """Particles of a frame, in the order of the log."""

    id: NDArray[np.uint32]
    """(n) Identity; that of an image has the highest bit."""
    image: NDArray[np.bool_]
    """(n) True of images in the plane of symmetry."""


class BodyMotion(TypedDict):
    """A body's motion, and the water's load on it."""

    position: NDArray[np.float64]
    """The reference point [m]."""
    angle: float
    """Counter-clockwise [rad]."""
    velocity: NDArray[np.float64]
    """Of the reference point [m/s]."""
    angular_velocity: float
    """[rad/s]."""
    acceleration: NDArray[np.float64]
    """Of the reference point [m/s²]."""
    force: NDArray[np.float64]
    """Of the water, per metre of span [N/m]."""
    moment: float
    """Of the water about the reference point, per metre of span [N]."""


class Nodes(TypedDict):
    """Nodes of a host; arrays of the caller's own."""

    position: NDArray[np.float64]
    """(n, 2) [m]."""
    velocity: NDArray[np.float64]
    """(n, 2) [m/s]."""
    rotation: NDArray[np.float64]
    """(n), or empty where nodes have no rotations [rad]."""
    spin: NDArray[np.float64]
    """(n), or empty [rad/s]."""


class Sizes(TypedDict):
    """Sizes of a host's water."""

    fluid_particles: int
    wall_particles: int
    bytes: int


class Snapshot(TypedDict):
    """The water around a host's nodes at one instant, particles in the order of their identity."""

    time: float
    position: NDArray[np.float64]
    velocity: NDArray[np.float64]
    pressure: NDArray[np.float64]
    spacing: NDArray[np.float64]
    surface: list[NDArray[np.float64]]
    nodes: Nodes
    force: NDArray[np.float64]


class BodyShape(TypedDict):
    """A body in a frame."""

    position: NDArray[np.float64]
    """The reference point [m]."""
    angle: float
    """Counter-clockwise [rad]."""
    outline: list[NDArray[np.float64]]
    """Closed lines of points in space, (m, 2) each [m]."""
