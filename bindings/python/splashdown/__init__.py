"""Water impact and ditching in two dimensions.

run(scene)          runs a scene as the command does: a Run with summary, series and frames
open(folder)        the same of a run that has ended
Simulation(scene)   a scene stepped from Python
Host(scene)         a scene whose body is moved from Python
evaluate(scene)     results of a scene in a loop: without files, and equal ones run once
sweep(scene, axes)  a scene at many points, in processes of their own
scenes()            names of the built-in scenes
check(scene)        a scene resolved, and the warnings about it

A scene is the name of a built-in scene or the path of a TOML file; `set` overrides its keys as the command's --set does. Units are SI,
loads per metre of span. Mistakes in what is given raise InputError, failed steps and runs StepError.
"""

from splashdown._core import Contribution, Host, InputError, Simulation, StepError, __version__, check, scenes
from splashdown._evaluate import CacheInfo, Result, Results, cache_clear, cache_info, evaluate
from splashdown._run import Run, open, run
from splashdown._sweep import Sweep, sweep

__all__ = [
    "CacheInfo",
    "Contribution",
    "Host",
    "InputError",
    "Result",
    "Results",
    "Run",
    "Simulation",
    "StepError",
    "Sweep",
    "__version__",
    "cache_clear",
    "cache_info",
    "check",
    "evaluate",
    "open",
    "run",
    "scenes",
    "sweep",
]
