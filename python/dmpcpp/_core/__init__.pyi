"""
Dynamic movement primitives and inverse kinematics: the C++ libraries dmp::core and dmp::kinematics.
"""
from __future__ import annotations
import collections.abc
import enum
import numpy
import numpy.typing
import os
import typing
from . import so3
__all__: list[str] = ['Alignment', 'Arm', 'Box', 'Capsule', 'Cycle', 'Demand', 'Demonstration', 'Derivatives', 'Dmp', 'DmpDistribution', 'DmpOptions', 'DmpParameters', 'DmpSequence', 'DmpSequenceRun', 'EndPeaks', 'FileError', 'FitReport', 'FollowOptions', 'ForcingTarget', 'GaussianBasis', 'Given', 'IkBackend', 'IkBatch', 'IkBranches', 'IkOptions', 'IkResult', 'IkStatus', 'Integrator', 'InvalidArgument', 'InverseKinematics', 'JointTracker', 'JointTrajectory', 'Kernels', 'LimitSource', 'LogBranch', 'Motion', 'NoiseEstimate', 'NoiseKind', 'OrientationCycle', 'OrientationDemonstration', 'OrientationDistribution', 'OrientationDmp', 'OrientationDmpParameters', 'OrientationDmpSequence', 'OrientationDmpSequenceRun', 'OrientationForm', 'OrientationRun', 'OrientationRunState', 'OrientationSpread', 'OrientationTrajectory', 'OrientationTrajectoryBatch', 'Pace', 'Paced', 'PacedLimit', 'PathFit', 'PathReport', 'Plane', 'PoseCycle', 'PoseDemonstration', 'PoseDistribution', 'PoseDmp', 'PoseDmpParameters', 'PoseDmpSequence', 'PoseDmpSequenceRun', 'PoseGripperDemonstration', 'PoseGripperDistribution', 'PoseGripperDmp', 'PoseGripperDmpParameters', 'PoseGripperDmpSequence', 'PoseGripperDmpSequenceRun', 'PoseGripperRun', 'PoseGripperRunState', 'PoseGripperTrajectory', 'PoseGripperTrajectoryBatch', 'PoseRun', 'PoseRunState', 'PoseSpread', 'PoseTrajectory', 'PoseTrajectoryBatch', 'Regression', 'Run', 'RunState', 'SafetyFilter', 'Scaling', 'Sphere', 'SplineEnds', 'Spread', 'Start', 'Status', 'TrackOptions', 'Trajectory', 'TrajectoryBatch', 'Via', 'align', 'assess', 'average', 'blend', 'damping_of', 'duration_factor', 'fastest_tip', 'find_cycle', 'fit_forcing', 'fit_path', 'frechet', 'from_json', 'largest_demand', 'load', 'paced', 'retimed', 'save', 'so3', 'spread', 'stretched', 'time_optimal', 'tip_motion', 'to_json']
class InvalidArgument(ValueError):
    @property
    def argument(self) -> typing.Any:
        """
        Name of the argument that cannot be used; empty where it is no one of them.
        """
    @argument.setter
    def argument(self, arg1: str) -> None:
        ...
class FileError(OSError):
    pass
class Trajectory:
    """
    A motion over time: what Dmp.rollout returns.
    """
    def __getstate__(self) -> tuple:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, d) per s^2
        """
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, d)
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, d) per s
        """
class OrientationTrajectory:
    """
    A motion over time: what OrientationDmp.rollout returns.
    """
    def __getstate__(self) -> tuple:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def angular_acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 3) rad/s^2, world frame
        """
    @property
    def angular_velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 3) rad/s, world frame
        """
    @property
    def rotation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 3, 3) body -> world
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s
        """
class PoseTrajectory:
    """
    A motion over time: what PoseDmp.rollout returns.
    """
    def __getstate__(self) -> tuple:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 6) the twist's rate, m/s^2 and rad/s^2
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 4, 4) [R p; 0 1], body -> world
        """
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 3) m
        """
    @property
    def rotation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 3, 3)
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s
        """
    @property
    def twist(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 6) linear velocity of the origin [m/s], angular velocity [rad/s], world frame
        """
class NoiseKind(enum.Enum):
    """
    none: samples are learned as they are; white: each has an error of its own; coloured: the error wanders, as that of a tracker.
    """
    coloured: typing.ClassVar[NoiseKind]
    none: typing.ClassVar[NoiseKind]
    white: typing.ClassVar[NoiseKind]
    @classmethod
    def __new__(cls, value):
        ...
class NoiseEstimate:
    """
    Whether samples carry noise that can be taken out without taking part of the motion, and the evidence. White noise is taken out if freedom <= 0.5, flatness <= 1.55, evenness >= 0.5 or correlation <= 0.1, and sharpness >= 1.25.
    """
    @property
    def correlation(self) -> float:
        """
        of neighbouring residuals where the motion is busy; below 0 for noise
        """
    @property
    def cutoff(self) -> float:
        """
        Hz, where the smoothing leaves half the power; 0 if none
        """
    @property
    def evenness(self) -> float:
        """
        residual where the motion is calm over that where it is busy; 1 for noise
        """
    @property
    def flatness(self) -> float:
        """
        sqrt(V(.6) / V(.8)), V(e) the variance left by a fit of freedom e; 1.2 for noise
        """
    @property
    def found(self) -> bool:
        """
        whether the kind is not none
        """
    @property
    def freedom(self) -> float:
        """
        degrees of freedom of the smoothed motion over the samples that were measured
        """
    @property
    def kind(self) -> NoiseKind:
        ...
    @property
    def measured(self) -> int:
        """
        samples that were measured, not filled in or held
        """
    @property
    def removed(self) -> float:
        """
        root of the mean square that smoothing takes out, all axes together
        """
    @property
    def resting(self) -> float:
        """
        speed where the motion is busy over that where it is calm
        """
    @property
    def sharpness(self) -> float:
        """
        largest acceleration of the samples as they are over that of the smoothed motion
        """
    @property
    def sigma(self) -> float:
        """
        standard deviation along one axis, unit of the samples or rad; 0 if there is none
        """
    @property
    def unpredicted(self) -> float:
        """
        RMS by which a sample differs from what its six neighbours predict, all axes together
        """
class Demonstration:
    """
    Positions over time as they were recorded, in any number of dimensions.
    """
    def __init__(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        times (T,) s, strictly increasing; positions (T, d) or (T,), T >= 2. Raises InvalidArgument naming the sample.
        """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Trajectory:
        """
        Position, velocity and acceleration on the quintic spline at times (n,) in s from the start.
        """
    def denoised(self) -> Demonstration:
        """
        The same motion without its noise, where the samples show that they carry any, otherwise as it is; see noise_estimate() and NoiseEstimate.
        """
    def noise_estimate(self) -> NoiseEstimate:
        """
        Whether the samples carry noise that can be taken out, with the evidence.
        """
    def smoothed(self) -> Demonstration:
        """
        The same motion on the smoothing spline: the noise is found in the data (generalised cross-validation) and taken out; see assess().
        """
    def with_measured(self, measured: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Demonstration:
        """
        The same motion, of whose samples some were filled in: measured (T,), 0 or False for those. They show the way, but no noise.
        """
    @property
    def dimension(self) -> int:
        ...
    @property
    def duration(self) -> float:
        """
        s
        """
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, d)
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s, from 0
        """
class OrientationDemonstration:
    """
    Orientations over time as they were recorded.
    """
    @staticmethod
    def from_euler(times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], angles: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], convention: str) -> OrientationDemonstration:
        """
        times (T,) s; angles (T, 3) rad; convention as in so3.from_euler, such as "ZYX".
        """
    @staticmethod
    def from_quaternions(times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], quaternions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], order: str) -> OrientationDemonstration:
        """
        times (T,) s; quaternions (T, 4) body -> world, of length 1 to 1e-2, in the order "wxyz" or "xyzw"; q and -q are one rotation.
        """
    def __init__(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotations: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        times (T,) s, strictly increasing; rotations (T, 3, 3) body -> world. Raises InvalidArgument, naming the sample, for a reflection, a matrix not orthogonal to 1e-3, or neighbours more than pi/2 apart.
        """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> OrientationTrajectory:
        """
        Rotation, angular velocity and acceleration on the quintic spline at times (n,) in s from the start.
        """
    def denoised(self) -> OrientationDemonstration:
        """
        The same motion without its noise, where the samples show that they carry any, otherwise as it is; see noise_estimate() and NoiseEstimate.
        """
    def noise_estimate(self) -> NoiseEstimate:
        """
        Whether the samples carry noise that can be taken out, with the evidence.
        """
    def smoothed(self) -> OrientationDemonstration:
        """
        The same motion on the smoothing spline: the noise is found in the data (generalised cross-validation) and taken out; see assess().
        """
    def with_measured(self, measured: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> OrientationDemonstration:
        """
        The same motion, of whose samples some were filled in: measured (T,), 0 or False for those. They show the way, but no noise.
        """
    @property
    def duration(self) -> float:
        """
        s
        """
    @property
    def rotation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 3, 3)
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s, from 0
        """
class PoseDemonstration:
    """
    Poses over time as they were recorded.
    """
    @staticmethod
    def from_quaternions(times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], quaternions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], order: str) -> PoseDemonstration:
        """
        times (T,) s; positions (T, 3) m; quaternions (T, 4) body -> world in the order "wxyz" or "xyzw".
        """
    def __init__(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], poses: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        times (T,) s, strictly increasing; poses (T, 4, 4) [R p; 0 1], body -> world, p in m. Raises InvalidArgument naming the sample.
        """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def denoised(self) -> PoseDemonstration:
        """
        The same motion without its noise, where the samples show that they carry any, otherwise as it is; see noise_estimate() and NoiseEstimate.
        """
    def noise(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6,) standard deviation of the noise found in the data by generalised cross-validation: of positions [m, x y z], of orientations [rad, the same about x y z]; 0 where there are fewer than ten samples
        """
    def noise_estimates(self) -> tuple[NoiseEstimate, NoiseEstimate]:
        """
        Whether positions [m] and orientations [rad] carry noise that can be taken out, with the evidence.
        """
    def smoothed(self) -> PoseDemonstration:
        """
        The same motion on the smoothing spline: the noise is found in the data (generalised cross-validation) and taken out; see assess().
        """
    def with_measured(self, measured: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> PoseDemonstration:
        """
        The same motion, of whose samples some were filled in: measured (T,), 0 or False for those. They show the way, but no noise.
        """
    @property
    def duration(self) -> float:
        """
        s
        """
    @property
    def orientation(self) -> OrientationDemonstration:
        ...
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 4, 4)
        """
    @property
    def position(self) -> Demonstration:
        ...
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s, from 0
        """
class Kernels(enum.Enum):
    """
    How the kernels lie over the phase.
    """
    equal_in_time: typing.ClassVar[Kernels]
    source: typing.ClassVar[Kernels]
    @classmethod
    def __new__(cls, value):
        ...
class Regression(enum.Enum):
    """
    How the weights are found.
    """
    automatic: typing.ClassVar[Regression]
    lwr: typing.ClassVar[Regression]
    ridge: typing.ClassVar[Regression]
    @classmethod
    def __new__(cls, value):
        ...
class Scaling(enum.Enum):
    """
    How the forcing term follows when start and goal change; automatic: advance.
    """
    advance: typing.ClassVar[Scaling]
    automatic: typing.ClassVar[Scaling]
    none: typing.ClassVar[Scaling]
    per_axis: typing.ClassVar[Scaling]
    per_axis_relative: typing.ClassVar[Scaling]
    rotation_dilation: typing.ClassVar[Scaling]
    @classmethod
    def __new__(cls, value):
        ...
class OrientationForm(enum.Enum):
    """
    The equation of motion of orientations.
    """
    automatic: typing.ClassVar[OrientationForm]
    log_linear: typing.ClassVar[OrientationForm]
    turning: typing.ClassVar[OrientationForm]
    ude: typing.ClassVar[OrientationForm]
    @classmethod
    def __new__(cls, value):
        ...
class Motion(enum.Enum):
    """
    From a start to a goal, or round and round about a centre, which is the goal then.
    """
    discrete: typing.ClassVar[Motion]
    rhythmic: typing.ClassVar[Motion]
    @classmethod
    def __new__(cls, value):
        ...
class LogBranch(enum.Enum):
    """
    Log(Rg R^T) followed through pi, or the shortest rotation.
    """
    lifted: typing.ClassVar[LogBranch]
    principal: typing.ClassVar[LogBranch]
    @classmethod
    def __new__(cls, value):
        ...
class Derivatives(enum.Enum):
    """
    Velocities and accelerations of a demonstration.
    """
    automatic: typing.ClassVar[Derivatives]
    gradient: typing.ClassVar[Derivatives]
    interpolate: typing.ClassVar[Derivatives]
    smooth: typing.ClassVar[Derivatives]
    @classmethod
    def __new__(cls, value):
        ...
class Start(enum.Enum):
    """
    What a rollout starts with.
    """
    demonstrated: typing.ClassVar[Start]
    rest: typing.ClassVar[Start]
    @classmethod
    def __new__(cls, value):
        ...
class Integrator(enum.Enum):
    """
    How a run steps.
    """
    exact: typing.ClassVar[Integrator]
    semi_implicit_euler: typing.ClassVar[Integrator]
    @classmethod
    def __new__(cls, value):
        ...
class DmpOptions:
    """
    Every choice there is in a Dmp, OrientationDmp or PoseDmp. The defaults reproduce.
    """
    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def source() -> DmpOptions:
        """
        The equations of the thesis proposal of 2019, read at tau = 1 with its errata E1, E6 and E7 fixed.
        """
    def __copy__(self) -> DmpOptions:
        ...
    def __deepcopy__(self, memo: dict) -> DmpOptions:
        ...
    def __eq__(self, arg0: typing.Any) -> bool:
        ...
    def __getstate__(self) -> dict:
        ...
    def __init__(self, **kwargs) -> None:
        """
        The fields as keywords; enumerators also by name: DmpOptions(regression="ridge").
        """
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    def validate(self) -> None:
        """
        Raises InvalidArgument, naming the field, for one outside its range.
        """
    @property
    def alpha(self) -> float:
        """
        spring and damper: tau zd = alpha (beta (g - y) - z) + f
        """
    @alpha.setter
    def alpha(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def alpha_x(self) -> float:
        """
        decay of the phase variable
        """
    @alpha_x.setter
    def alpha_x(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def basis_count(self) -> int:
        """
        N, kernels; 0: as many as the demonstrations need
        """
    @basis_count.setter
    def basis_count(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def beta(self) -> float | None:
        """
        alpha / 4 unless given: critically damped
        """
    @beta.setter
    def beta(self, arg0: typing.SupportsFloat | typing.SupportsIndex | None) -> None:
        ...
    @property
    def derivatives(self) -> Derivatives:
        """
        a Derivatives or its name
        """
    @derivatives.setter
    def derivatives(self, arg1: typing.Any) -> None:
        ...
    @property
    def force_after_end(self) -> bool:
        """
        the forcing term goes on after the duration
        """
    @force_after_end.setter
    def force_after_end(self, arg0: bool) -> None:
        ...
    @property
    def goal_filter(self) -> float:
        """
        a new goal is approached by tau gd = goal_filter (g* - g)
        """
    @goal_filter.setter
    def goal_filter(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def integrator(self) -> Integrator:
        """
        an Integrator or its name
        """
    @integrator.setter
    def integrator(self, arg1: typing.Any) -> None:
        ...
    @property
    def kernels(self) -> Kernels:
        """
        a Kernels or its name
        """
    @kernels.setter
    def kernels(self, arg1: typing.Any) -> None:
        ...
    @property
    def log_branch(self) -> LogBranch:
        """
        a LogBranch or its name
        """
    @log_branch.setter
    def log_branch(self, arg1: typing.Any) -> None:
        ...
    @property
    def motion(self) -> Motion:
        """
        a Motion or its name; rhythmic: a demonstration is one cycle, its last sample the first one again (find_cycle), its duration the period
        """
    @motion.setter
    def motion(self, arg1: typing.Any) -> None:
        ...
    @property
    def orientation_alpha(self) -> float | None:
        """
        alpha unless given
        """
    @orientation_alpha.setter
    def orientation_alpha(self, arg0: typing.SupportsFloat | typing.SupportsIndex | None) -> None:
        ...
    @property
    def orientation_beta(self) -> float | None:
        """
        beta unless given; orientation_alpha / 4 if only that is given
        """
    @orientation_beta.setter
    def orientation_beta(self, arg0: typing.SupportsFloat | typing.SupportsIndex | None) -> None:
        ...
    @property
    def orientation_form(self) -> OrientationForm:
        """
        an OrientationForm or its name
        """
    @orientation_form.setter
    def orientation_form(self, arg1: typing.Any) -> None:
        ...
    @property
    def overlap(self) -> float | None:
        """
        neighbours cross at exp(-overlap / 4); ln 2 (lwr), 0.2 (ridge)
        """
    @overlap.setter
    def overlap(self, arg0: typing.SupportsFloat | typing.SupportsIndex | None) -> None:
        ...
    @property
    def passes(self) -> int:
        """
        of locally weighted regression; 1 is the textbook's
        """
    @passes.setter
    def passes(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def phase_stop(self) -> float:
        """
        k: a tracking error e slows the phase to 1 / (tau (1 + k e))
        """
    @phase_stop.setter
    def phase_stop(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def regression(self) -> Regression:
        """
        a Regression or its name
        """
    @regression.setter
    def regression(self, arg1: typing.Any) -> None:
        ...
    @property
    def ridge(self) -> float:
        """
        times trace / N on the diagonal
        """
    @ridge.setter
    def ridge(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def scaling(self) -> Scaling:
        """
        a Scaling or its name
        """
    @scaling.setter
    def scaling(self, arg1: typing.Any) -> None:
        ...
    @property
    def scaling_guard(self) -> bool:
        """
        a scaling that multiplies gives way to advance where its ratio is badly conditioned; see scaling_notes of a model
        """
    @scaling_guard.setter
    def scaling_guard(self, arg0: bool) -> None:
        ...
    @property
    def start(self) -> Start:
        """
        a Start or its name
        """
    @start.setter
    def start(self, arg1: typing.Any) -> None:
        ...
    @property
    def tempo_filter(self) -> float:
        """
        s, time constant with which a change of tempo (duration, pause, phase stop) is approached
        """
    @tempo_filter.setter
    def tempo_filter(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
class Status(enum.Enum):
    """
    What a call inside the control loop says.
    """
    blocked: typing.ClassVar[Status]
    finished: typing.ClassVar[Status]
    invalid_input: typing.ClassVar[Status]
    not_finite: typing.ClassVar[Status]
    running: typing.ClassVar[Status]
    too_late: typing.ClassVar[Status]
    @classmethod
    def __new__(cls, value):
        ...
class EndPeaks:
    """
    Accelerations (m/s^2, rad/s^2) in the first and the last 3 % of a demonstration: the largest of the model, and the largest second difference of the samples, which hold no more.
    """
    @property
    def goal(self) -> float:
        """
        of the model, in the last 3 %
        """
    @property
    def goal_samples(self) -> float:
        """
        what the samples hold there
        """
    @property
    def start(self) -> float:
        """
        of the model, in the first 3 %
        """
    @property
    def start_samples(self) -> float:
        """
        what the samples hold there
        """
class FitReport:
    """
    How a model reproduces demonstrations. Columns: dimensions of a position; components of the rotation vector between the orientations; for poses three of each.
    """
    @property
    def condition(self) -> float:
        """
        of the regression's matrix
        """
    @property
    def ends(self) -> list[list[EndPeaks]]:
        """
        the accelerations at the ends of each demonstration: a list of EndPeaks, as evidence
        """
    @property
    def evidence(self) -> list[list[NoiseEstimate]]:
        """
        what each demonstration shows of noise: a list of NoiseEstimate, of its positions, of its orientations, or of both
        """
    @property
    def largest(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,)
        """
    @property
    def largest_log(self) -> float:
        """
        rad, the largest |Log(Rg R^T)| on the way
        """
    @property
    def noise(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,) standard deviation found in the data
        """
    @property
    def removed(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,) root of the mean square that smoothing took out; 0 unless it was asked for
        """
    @property
    def rmse(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,)
        """
    @property
    def suggested_basis_count(self) -> int:
        """
        the fewest of 10, 20, 40, .. 1280 kernels that reach the tolerance; 0: none does
        """
    @property
    def warnings(self) -> list[str]:
        ...
class GaussianBasis:
    """
    Gaussian kernels over the phase.
    """
    @staticmethod
    def equal_in_time(count: typing.SupportsInt | typing.SupportsIndex, alpha_x: typing.SupportsFloat | typing.SupportsIndex, overlap: typing.SupportsFloat | typing.SupportsIndex) -> GaussianBasis:
        """
        Kernels of one width in time; neighbours cross at exp(-overlap / 4).
        """
    @staticmethod
    def source(count: typing.SupportsInt | typing.SupportsIndex, alpha_x: typing.SupportsFloat | typing.SupportsIndex) -> GaussianBasis:
        """
        Kernels in x = exp(-alpha_x s) by DeWolf's rule.
        """
    def activations(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], normalised: bool = False) -> numpy.typing.NDArray[numpy.float64]:
        """
        The kernels (T, N) at phases (T,); rows sum to 1 if normalised.
        """
    def features(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        What the forcing term is linear in (T, N): features(phase) @ weights is the forcing term.
        """
    @property
    def alpha_x(self) -> float:
        ...
    @property
    def centers(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,) in x
        """
    @property
    def count(self) -> int:
        """
        N
        """
class ForcingTarget:
    """
    What a forcing term should be along one demonstration.
    """
    def __init__(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], value: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], scale: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> None:
        """
        phase (K,), increasing; value (K, dims); scale (dims,), 1 unless given.
        """
    @property
    def phase(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K,)
        """
    @property
    def scale(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (dims,): value = scale * (basis.features(phase) @ weights)
        """
    @property
    def value(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, dims)
        """
class Spread:
    """
    Where demonstrations of one motion lie over the phase, each taken at t / duration.
    """
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, d, d) of one demonstration about the mean
        """
    @property
    def mean(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, d)
        """
    @property
    def phase(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K,) 0 to 1
        """
class PoseSpread:
    """
    Where demonstrations of one motion lie over the phase, for poses.
    """
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, 6, 6) of position [m] and rotation vector from the mean [rad, world frame]
        """
    @property
    def mean(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, 4, 4)
        """
    @property
    def phase(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K,) 0 to 1
        """
class OrientationSpread:
    """
    Where demonstrations of one motion lie over the phase, for orientations.
    """
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, 3, 3) of the rotation vector from the mean [rad, world frame]
        """
    @property
    def mean(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, 3, 3)
        """
    @property
    def phase(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K,) 0 to 1
        """
class Cycle:
    """
    One cycle of a recorded motion, and how it was found.
    """
    def __repr__(self) -> str:
        ...
    @property
    def begins(self) -> float:
        """
        s from the start of the recording: what lies before differs from what follows
        """
    @property
    def demonstration(self) -> Demonstration:
        """
        201 samples, the last one the first again: what motion="rhythmic" learns from
        """
    @property
    def ends(self) -> float:
        """
        s, likewise behind
        """
    @property
    def lengths(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        s, of each whole cycle
        """
    @property
    def period(self) -> float:
        """
        s, the mean of the cycles
        """
    @property
    def unexplained(self) -> float:
        """
        RMS that the cycle leaves of the motion about its middle, a share of it
        """
class OrientationCycle:
    """
    One cycle of a recorded motion, and how it was found.
    """
    def __repr__(self) -> str:
        ...
    @property
    def begins(self) -> float:
        """
        s from the start of the recording: what lies before differs from what follows
        """
    @property
    def demonstration(self) -> OrientationDemonstration:
        """
        201 samples, the last one the first again: what motion="rhythmic" learns from
        """
    @property
    def ends(self) -> float:
        """
        s, likewise behind
        """
    @property
    def lengths(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        s, of each whole cycle
        """
    @property
    def period(self) -> float:
        """
        s, the mean of the cycles
        """
    @property
    def unexplained(self) -> float:
        """
        RMS that the cycle leaves of the motion about its middle, a share of it
        """
class PoseCycle:
    """
    One cycle of a recorded motion, and how it was found.
    """
    def __repr__(self) -> str:
        ...
    @property
    def begins(self) -> float:
        """
        s from the start of the recording: what lies before differs from what follows
        """
    @property
    def demonstration(self) -> PoseDemonstration:
        """
        201 samples, the last one the first again: what motion="rhythmic" learns from
        """
    @property
    def ends(self) -> float:
        """
        s, likewise behind
        """
    @property
    def lengths(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        s, of each whole cycle
        """
    @property
    def period(self) -> float:
        """
        s, the mean of the cycles
        """
    @property
    def unexplained(self) -> float:
        """
        RMS that the cycle leaves of the motion about its middle, a share of it
        """
class Via:
    """
    A point or pose that a motion passes at a phase.
    """
    def __init__(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: typing.Any, velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> None:
        """
        phase: 0.01 to 0.99, 0.01 or more from the next one. point: as the model's goal. velocity (d,) per s: what the motion has there, unless it is left free. reach: the part of the phase within which the motion is changed, before and behind, or (before, behind).
        """
    def __repr__(self) -> str:
        ...
    @property
    def phase(self) -> float:
        ...
    @property
    def point(self) -> typing.Any:
        ...
    @property
    def reach(self) -> float | tuple[float, float]:
        ...
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64] | None:
        ...
class Sphere:
    """
    A ball that a motion must not touch.
    """
    def __init__(self, center: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], radius: typing.SupportsFloat | typing.SupportsIndex, velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> None:
        """
        center (3,) m; radius m, 0 or more; velocity (3,) m/s, none unless given.
        """
    def __repr__(self) -> str:
        ...
    def distance(self, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        """
        Distance of points (N, 3) m, or of one (3,), to the surface, m (N,); negative inside.
        """
    def gradient(self, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) the unit gradient of the distance at a point (3,) m: the way out.
        """
    @property
    def center(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m
        """
    @property
    def radius(self) -> float:
        """
        m
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m/s
        """
class Box:
    """
    A box, turned as it may be.
    """
    def __init__(self, pose: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], half_sizes: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> None:
        """
        pose (4, 4) of its centre; half_sizes (3,) m along its axes; velocity (3,) m/s.
        """
    def __repr__(self) -> str:
        ...
    def distance(self, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        """
        Distance of points (N, 3) m, or of one (3,), to the surface, m (N,); negative inside.
        """
    def gradient(self, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) the unit gradient of the distance at a point (3,) m: the way out.
        """
    @property
    def half_sizes(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4)
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m/s
        """
class Capsule:
    """
    All points within a radius of a line: a link, a person's arm.
    """
    def __init__(self, start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], end: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], radius: typing.SupportsFloat | typing.SupportsIndex, velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> None:
        """
        start, end (3,) m; radius m, 0 or more; velocity (3,) m/s.
        """
    def __repr__(self) -> str:
        ...
    def distance(self, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        """
        Distance of points (N, 3) m, or of one (3,), to the surface, m (N,); negative inside.
        """
    def gradient(self, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) the unit gradient of the distance at a point (3,) m: the way out.
        """
    @property
    def end(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m
        """
    @property
    def radius(self) -> float:
        """
        m
        """
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m/s
        """
class Plane:
    """
    Everything behind a plane: a table, a wall.
    """
    def __init__(self, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], normal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> None:
        """
        point (3,) m on it; normal (3,), of any length, leads to the free side; velocity (3,) m/s.
        """
    def __repr__(self) -> str:
        ...
    def distance(self, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        """
        Distance of points (N, 3) m, or of one (3,), to the surface, m (N,); negative inside.
        """
    def gradient(self, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) the unit gradient of the distance at a point (3,) m: the way out.
        """
    @property
    def normal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,)
        """
    @property
    def point(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m/s
        """
class SafetyFilter:
    """
    Keeps limits and stays clear of obstacles behind a run: run.step(dt, filter=filter). Limits are never exceeded, an obstacle that stands still is never touched, where the motion begins within the limits with room to stop; where nothing else is left the motion brakes and run.status is Status.blocked.
    """
    def __copy__(self) -> SafetyFilter:
        ...
    def __deepcopy__(self, memo: dict) -> SafetyFilter:
        ...
    def __init__(self, obstacles: collections.abc.Sequence[Sphere | Box | Capsule | Plane] = (), *, lower: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, upper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, acceleration: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, angular_velocity: typing.SupportsFloat | typing.SupportsIndex = ..., angular_acceleration: typing.SupportsFloat | typing.SupportsIndex = ..., margin: typing.SupportsFloat | typing.SupportsIndex = 0.01, radius: typing.SupportsFloat | typing.SupportsIndex = 0.0, gain: typing.SupportsFloat | typing.SupportsIndex = 30.0, largest_step: typing.SupportsFloat | typing.SupportsIndex = 0.01, slide: bool = True, room: typing.SupportsInt | typing.SupportsIndex = 8) -> None:
        """
        obstacles: Sphere, Box, Capsule or Plane, each. lower, upper, velocity, acceleration (axes,): limits of every axis (of a pose those of its position), inf for none. angular_velocity, angular_acceleration: of their norms, rad/s and rad/s^2. margin: what is kept from obstacles, m, above 0. radius: of the tool, m. gain: how late the motion gives way, 1 to 100 per duration. largest_step: steps are divided so that none is longer, s. slide: pushes along the surface of what lies straight ahead. room: obstacles that fit in at once, 1 to 256.
        """
    def __repr__(self) -> str:
        ...
    def clear(self) -> None:
        """
        Removes all obstacles.
        """
    def remove(self, index: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def set(self, index: typing.SupportsInt | typing.SupportsIndex, obstacle: Sphere | Box | Capsule | Plane) -> None:
        """
        The obstacle of a number, 0 to room - 1, as it is now.
        """
    def set_tracking_error(self, error: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        How far the robot may be from where it should be, m: kept from obstacles in addition to the margin.
        """
    @property
    def changed(self) -> bool:
        """
        whether the last step changed the motion
        """
    @property
    def clearance(self) -> float:
        """
        least distance from the tool to an obstacle after the last step, m
        """
    @property
    def obstacles(self) -> list:
        """
        a list of `room`: each where it has been carried to, None where there is none
        """
    @property
    def room(self) -> int:
        """
        how many obstacles fit in at once
        """
class Given:
    """
    What is known of a motion at a phase, for the condition of a distribution.
    """
    def __init__(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: typing.Any | None = None, velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, covariance: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, velocity_covariance: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, axes: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = ()) -> None:
        """
        phase: 0 to 1. point: as a model's goal; of poses a position (3,) too, whatever the rotation. velocity (d,) per s. covariance (d, d) of the point, velocity_covariance (d, d) of the velocity, of rotations about the axes of the world: known exactly unless given. axes: that are known, 0 to d - 1, positions first; all by default.
        """
    def __repr__(self) -> str:
        ...
    @property
    def axes(self) -> list[int]:
        ...
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64] | None:
        ...
    @property
    def phase(self) -> float:
        ...
    @property
    def point(self) -> typing.Any | None:
        ...
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64] | None:
        ...
    @property
    def velocity_covariance(self) -> numpy.typing.NDArray[numpy.float64] | None:
        ...
class DmpParameters:
    """
    All that a Dmp is: what a model file holds. Fields as keywords.
    """
    options: DmpOptions
    def __init__(self, **kwargs) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def advance(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @advance.setter
    def advance(self, arg1: typing.Any) -> None:
        ...
    @property
    def amplitude(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @amplitude.setter
    def amplitude(self, arg1: typing.Any) -> None:
        ...
    @property
    def duration(self) -> float:
        ...
    @duration.setter
    def duration(self, arg1: typing.Any) -> None:
        ...
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @goal.setter
    def goal(self, arg1: typing.Any) -> None:
        ...
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @start.setter
    def start(self, arg1: typing.Any) -> None:
        ...
    @property
    def start_velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @start_velocity.setter
    def start_velocity(self, arg1: typing.Any) -> None:
        ...
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @weights.setter
    def weights(self, arg1: typing.Any) -> None:
        ...
class TrajectoryBatch:
    """
    Many motions: what Dmp.rollout_each returns.
    """
    def __len__(self) -> int:
        ...
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, d) per s^2
        """
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, d)
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T) s
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, d) per s
        """
class Dmp:
    """
    A dynamic movement primitive for positions in R^d. Immutable.
    """
    @staticmethod
    @typing.overload
    def fit(demonstration: Demonstration, options: DmpOptions | None = None, *, learner: collections.abc.Callable | None = None, **kwargs) -> Dmp:
        """
        Learns from a demonstration, or from a list of them together. `options` is a DmpOptions; its fields may be given as keywords too: fit(demonstration, basis_count=50, regression="ridge"). `learner(basis, targets)` returns the weights (N, dims) in place of the options' regression.
        """
    @staticmethod
    @typing.overload
    def fit(demonstrations: collections.abc.Sequence[Demonstration], options: DmpOptions | None = None, *, learner: collections.abc.Callable | None = None, **kwargs) -> Dmp:
        ...
    @staticmethod
    @typing.overload
    def fit_each(demonstrations: collections.abc.Sequence[Demonstration], options: DmpOptions | None = None, threads: typing.SupportsInt | typing.SupportsIndex = 1, **kwargs) -> list[Dmp]:
        """
        One model for each demonstration, the same as fit gives. threads: how many to use, 0 for as many as the machine runs at once. Options as in fit.
        """
    @staticmethod
    @typing.overload
    def fit_each(times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], options: DmpOptions | None = None, threads: typing.SupportsInt | typing.SupportsIndex = 1, **kwargs) -> list[Dmp]:
        """
        The same for positions, (M, T, d), on one time grid, times (T,) s.
        """
    @staticmethod
    def targets(demonstrations: collections.abc.Sequence[Demonstration], options: DmpOptions | None = None, **kwargs) -> list[ForcingTarget]:
        """
        What fit learns from: the forcing term along each demonstration, one ForcingTarget each.
        """
    def __getstate__(self) -> str:
        ...
    def __init__(self, parameters: DmpParameters) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    def activations(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], normalised: bool = False) -> numpy.typing.NDArray[numpy.float64]:
        """
        The kernels (T, N) at phases (T,); rows sum to 1 if normalised.
        """
    def forcing(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        The forcing term (T, dims) at phases (T,), 0 at the start and 1 at the end.
        """
    def rollout(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, dt: typing.SupportsFloat | typing.SupportsIndex = 0.001, via: collections.abc.Sequence[Via] = ()) -> Trajectory:
        """
        The motion from the demonstrated start to `goal` (shaped as the property goal; the demonstrated one unless given) within `duration` s (the demonstrated one unless given), at 0, dt, ... and the duration, the last step shorter where dt does not divide it. Raises InvalidArgument for a wrong shape, a number that is not finite or not positive, more than 10^7 samples, or a motion that does not stay finite. `via`: a list of Via that it passes, in the order of their phases.
        """
    def rollout_at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, via: collections.abc.Sequence[Via] = ()) -> Trajectory:
        """
        The same at times (T,) in s, increasing from 0 or later.
        """
    def rollout_each(self, goals: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, durations: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, samples: typing.SupportsInt | typing.SupportsIndex = 1001, threads: typing.SupportsInt | typing.SupportsIndex = 1) -> TrajectoryBatch:
        """
        One motion for each of M goals (M, ...) and durations (M,) s, T = `samples` of each, evenly from 0 to its duration: the same as rollout(goal, duration, duration / (samples - 1)). Without goals, or without durations, the demonstrated one for all. threads: 0 for as many as the machine runs at once. Raises InvalidArgument, naming the motion, as rollout does.
        """
    def scaling_notes(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> list[str]:
        """
        Where the guard of the scaling steps in on the way to `goal` (the demonstrated one unless given), a line for each axis; see DmpOptions.scaling_guard.
        """
    def with_scaling(self, scaling: typing.Any) -> Dmp:
        """
        The same motion, led to new starts and goals by another Scaling, or its name. Of several demonstrations learned together it is the mean that is scaled. Raises InvalidArgument for an unknown one, or one that the form of orientations does not bear.
        """
    def with_weights(self, weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Dmp:
        """
        The same model with other weights (N, dims).
        """
    @property
    def basis(self) -> GaussianBasis:
        """
        The kernels of the forcing term.
        """
    @property
    def dimension(self) -> int:
        """
        axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        tau of the demonstration, s
        """
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,)
        """
    @property
    def options(self) -> DmpOptions:
        """
        A copy: what the model was learned with.
        """
    @property
    def parameters(self) -> DmpParameters:
        """
        A copy of all that the model is: change it and make another model.
        """
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,)
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, dims) of the forcing term; see with_weights
        """
class RunState:
    """
    What a coupling sees: the run at the start of an internal step.
    """
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        the one set last
        """
    @property
    def phase(self) -> float:
        """
        s, 0 at the start, 1 at the end
        """
    @property
    def point(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,)
        """
    @property
    def speed(self) -> float:
        """
        ds/dt as it is now, 1/s
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        per s; of rotations rad/s, world frame
        """
class Run:
    """
    One run of a Dmp, for one control loop.
    """
    def __copy__(self) -> Run:
        ...
    def __deepcopy__(self, memo: dict) -> Run:
        ...
    def __init__(self, dmp: Dmp) -> None:
        ...
    def ahead(self, phase: typing.SupportsFloat | typing.SupportsIndex) -> RunState:
        """
        Where the run will be at a phase from now to 1 if nothing changes until then, via-points included; speed and velocity at the duration that is set.
        """
    def clear_vias(self) -> None:
        """
        Forgets all via-points; what is under way fades within its reach.
        """
    @typing.overload
    def join(self, next: Dmp, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> None:
        """
        Goes on with another motion from the present state: a model, or a run of one that stands where it shall begin, with its goal, duration and via-points set. Position, velocity and acceleration do not jump; what lies between the two motions fades within `reach`, a part of the phase of `next`.
        """
    @typing.overload
    def join(self, next: Run, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> None:
        ...
    def move_via(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Status:
        """
        The via-point that was set at `phase` has moved. Returns Status.running, or Status.too_late where it lies behind.
        """
    def pause(self) -> None:
        """
        Comes to rest on the path, through options.tempo_filter.
        """
    def reset(self) -> None:
        """
        Begins anew at the demonstrated start, with the goal and duration that were set last.
        """
    def resume(self) -> None:
        """
        Goes on from there.
        """
    def set_tracking_error(self, error: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        How far the robot lags behind: slows the phase by 1 + options.phase_stop times it.
        """
    @typing.overload
    def start_from(self, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        Begins anew at position (d,) with velocity (d,) per s.
        """
    @typing.overload
    def start_from(self, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex]) -> None:
        """
        Begins anew, from any point and velocity with no acceleration, and comes onto the learned motion within `reach`, a part of the phase: nothing jumps, and behind it nothing is changed.
        """
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex, coupling: collections.abc.Callable | None = None, filter: SafetyFilter = None) -> bool:
        """
        Moves on by dt seconds. True while the motion runs, False when it has finished; raises FloatingPointError when the state is not finite. `coupling(state)`, called in each internal step, returns what is added to the forcing term (d,): an acceleration divided by state.speed**2. Where it raises, the run stays as it was. `filter`, a SafetyFilter, changes where the run is so that limits are kept and obstacles not touched; status is Status.blocked where they leave no way on.
        """
    def via(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> Status:
        """
        Passes `point` (shaped as the property goal) at a phase that lies ahead, 0.01 to 0.99, and changes the motion within `reach` only, a part of the phase or one before and one behind: exactly, whatever happens to goal, duration or point until then. With `velocity` (d,) per s it has that there. Returns Status.running, or Status.too_late where less than 0.01 is left until there; raises InvalidArgument for what can be no via-point.
        """
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,) per s^2
        """
    @property
    def amplitude(self) -> float:
        """
        what the forcing term is multiplied by, 1 at first: of a rhythmic motion what it goes away from its centre; approached as a goal is
        """
    @amplitude.setter
    def amplitude(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def duration(self) -> float:
        """
        s, of the whole motion from now on; the path stays the same
        """
    @duration.setter
    def duration(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,) the goal to go to from now on, approached through the goal filter
        """
    @goal.setter
    def goal(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    @property
    def paused(self) -> bool:
        ...
    @property
    def phase(self) -> float:
        """
        0 at the start, 1 at the end
        """
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,)
        """
    @property
    def state(self) -> RunState:
        """
        where the run is: phase, speed, point, velocity and goal
        """
    @property
    def status(self) -> Status:
        ...
    @property
    def time(self) -> float:
        """
        s since the start
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,) per s
        """
class DmpSequence:
    """
    Motions one after another as one: each takes over where the one before is left, without a jump of position, velocity or acceleration. Immutable.
    """
    def __getstate__(self) -> str:
        ...
    def __init__(self, models: collections.abc.Sequence[Dmp], leave: typing.SupportsFloat | typing.SupportsIndex | collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = 1.0, reach: typing.SupportsFloat | typing.SupportsIndex | collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = 0.2, via: collections.abc.Sequence[collections.abc.Sequence[Via]] = ()) -> None:
        """
        models: 1 to 32. leave: the phase of each at which the next one takes over, 0.01 to 1, or one for all; below 1 without coming to rest. reach: the part of the phase of each, 0.01 to 1, within which it is come onto from the one before. via: a list of Via for each model. Raises InvalidArgument, naming the part.
        """
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    def rollout(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, dt: typing.SupportsFloat | typing.SupportsIndex = 0.001) -> Trajectory:
        """
        The whole motion, to `goal` at its end, within `duration` s (all parts in proportion), as the rollout of a model.
        """
    def rollout_at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None) -> Trajectory:
        """
        The same at times (T,) in s, increasing from 0 or later.
        """
    @property
    def dimension(self) -> int:
        """
        axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        s, of all as demonstrated
        """
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,)
        """
    @property
    def leave(self) -> list[float]:
        ...
    @property
    def models(self) -> list[Dmp]:
        ...
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d,)
        """
class DmpSequenceRun:
    """
    One run of a sequence, for one control loop.
    """
    def __init__(self, sequence: DmpSequence) -> None:
        ...
    def set_goal(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        The goal of the last motion.
        """
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex) -> bool:
        """
        Moves on by dt seconds. True while the motion runs, False when it has finished.
        """
    def stretch(self, factor: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        All durations times `factor`, from now on.
        """
    @property
    def part(self) -> int:
        """
        which motion is under way, from 0
        """
    @property
    def phase(self) -> float:
        """
        of that motion
        """
    @property
    def state(self) -> RunState:
        """
        where the run is: point, velocity, phase and goal of the motion that is under way
        """
    @property
    def time(self) -> float:
        """
        s since the start
        """
class DmpDistribution:
    """
    A probabilistic movement primitive for positions in R^d: a motion and how it varies, learned from several demonstrations. Immutable.
    """
    @staticmethod
    def fit(demonstrations: collections.abc.Sequence[Demonstration], *, control_points: typing.SupportsInt | typing.SupportsIndex = 14, prior: typing.SupportsFloat | typing.SupportsIndex = 8.0, iterations: typing.SupportsInt | typing.SupportsIndex = 20) -> DmpDistribution:
        """
        Learns two or more demonstrations of one motion by expectation maximisation, each taken at t / its duration. control_points: of the cubic B-splines over the phase, 4 to 200; prior: weight of the inverse-Wishart prior, in demonstrations, 0.1 to 1000. Raises InvalidArgument, naming it, for a demonstration that does not belong to the others.
        """
    def __getstate__(self) -> str:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    @typing.overload
    def condition(self, given: collections.abc.Sequence[Given]) -> DmpDistribution:
        """
        Of the motions that pass what is given: a list of Given, or a dict of points by their phases, which are passed exactly. Raises InvalidArgument, naming given[k], for phases, shapes or covariances out of range, and where nothing is left open: two exact points at one phase, or more of them than there are control points near by.
        """
    @typing.overload
    def condition(self, given: collections.abc.Mapping[typing.SupportsFloat | typing.SupportsIndex, typing.Any]) -> DmpDistribution:
        ...
    def continued(self, part: Demonstration, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, phase: typing.SupportsFloat | typing.SupportsIndex = 0.0, noise: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> DmpDistribution:
        """
        Of the motions that go on from a recording of their beginning, or of a part from `phase` on, at the pace of `duration` (s, of the whole motion; the mean one unless given). `noise` (parts,): standard deviation of a sample; unless given that of the demonstrations, with a share of the variance there. Raises InvalidArgument where the part does not lie within the motion.
        """
    def distance(self, given: Given) -> float:
        """
        How many standard deviations (Mahalanobis) what is given lies from the mean, noise included.
        """
    def log_likelihood(self, demonstration: Demonstration) -> float:
        """
        Logarithm of the density of a demonstration, taken at t / its duration: of all its numbers, in the units of the demonstrations.
        """
    def mean(self, options: DmpOptions | None = None, **kwargs) -> Dmp:
        """
        The mean as a primitive; options as its fit takes them.
        """
    def observation_covariance(self, phase: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d, d) how far an observed motion may lie from what the weights can say at a phase: for `covariance` of what was measured and not wished for.
        """
    def rollout(self, samples: typing.SupportsInt | typing.SupportsIndex = 101) -> Trajectory:
        """
        The mean motion over `duration`, at `samples` even times.
        """
    def sample(self, seed: typing.SupportsInt | typing.SupportsIndex = 0, samples: typing.SupportsInt | typing.SupportsIndex = 101) -> Trajectory:
        """
        One motion drawn from it; the same for the same seed.
        """
    def spread(self, count: typing.SupportsInt | typing.SupportsIndex = 101) -> Spread:
        """
        Mean and covariance at `count` even phases, without the noise of samples; of rotations about the axes of the world.
        """
    def stiffness(self, phase: typing.SupportsFloat | typing.SupportsIndex, most: typing.SupportsFloat | typing.SupportsIndex | typing.Annotated[numpy.typing.ArrayLike, numpy.float64], spread: typing.SupportsFloat | typing.SupportsIndex | typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d, d) stiffness that is high where the demonstrations agree: no more than `most`, half of it where their standard deviation is `spread`. Both: a positive number, or (d,). Positive definite by construction; see damping_of.
        """
    @property
    def control_points(self) -> int:
        """
        N, of the splines over the phase
        """
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N * d, N * d) of the weights
        """
    @property
    def demonstrations(self) -> int:
        """
        how many it was learned from
        """
    @property
    def dimension(self) -> int:
        """
        d, axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        s, mean of the demonstrations
        """
    @property
    def noise(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (parts,) standard deviation of a sample, of vectors and of rotations [rad]
        """
    @property
    def reference(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, columns) the motion at even phases that the weights deviate from; rotations as w x y z
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N * d,) mean of the weights, those of one control point together
        """
class OrientationDmpParameters:
    """
    All that a OrientationDmp is: what a model file holds. Fields as keywords.
    """
    options: DmpOptions
    def __init__(self, **kwargs) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def advance(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @advance.setter
    def advance(self, arg1: typing.Any) -> None:
        ...
    @property
    def amplitude(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @amplitude.setter
    def amplitude(self, arg1: typing.Any) -> None:
        ...
    @property
    def duration(self) -> float:
        ...
    @duration.setter
    def duration(self, arg1: typing.Any) -> None:
        ...
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @goal.setter
    def goal(self, arg1: typing.Any) -> None:
        ...
    @property
    def reference(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @reference.setter
    def reference(self, arg1: typing.Any) -> None:
        ...
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @start.setter
    def start(self, arg1: typing.Any) -> None:
        ...
    @property
    def start_error(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @start_error.setter
    def start_error(self, arg1: typing.Any) -> None:
        ...
    @property
    def start_velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @start_velocity.setter
    def start_velocity(self, arg1: typing.Any) -> None:
        ...
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @weights.setter
    def weights(self, arg1: typing.Any) -> None:
        ...
class OrientationTrajectoryBatch:
    """
    Many motions: what OrientationDmp.rollout_each returns.
    """
    def __len__(self) -> int:
        ...
    @property
    def angular_acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, 3) rad/s^2, world frame
        """
    @property
    def angular_velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, 3) rad/s, world frame
        """
    @property
    def rotation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, 3, 3) body -> world
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T) s
        """
class OrientationDmp:
    """
    A dynamic movement primitive for orientations on SO(3). Immutable.
    """
    @staticmethod
    @typing.overload
    def fit(demonstration: OrientationDemonstration, options: DmpOptions | None = None, *, learner: collections.abc.Callable | None = None, **kwargs) -> OrientationDmp:
        """
        Learns from a demonstration, or from a list of them together. `options` is a DmpOptions; its fields may be given as keywords too: fit(demonstration, basis_count=50, regression="ridge"). `learner(basis, targets)` returns the weights (N, dims) in place of the options' regression.
        """
    @staticmethod
    @typing.overload
    def fit(demonstrations: collections.abc.Sequence[OrientationDemonstration], options: DmpOptions | None = None, *, learner: collections.abc.Callable | None = None, **kwargs) -> OrientationDmp:
        ...
    @staticmethod
    @typing.overload
    def fit_each(demonstrations: collections.abc.Sequence[OrientationDemonstration], options: DmpOptions | None = None, threads: typing.SupportsInt | typing.SupportsIndex = 1, **kwargs) -> list[OrientationDmp]:
        """
        One model for each demonstration, the same as fit gives. threads: how many to use, 0 for as many as the machine runs at once. Options as in fit.
        """
    @staticmethod
    @typing.overload
    def fit_each(times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotations: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], options: DmpOptions | None = None, threads: typing.SupportsInt | typing.SupportsIndex = 1, **kwargs) -> list[OrientationDmp]:
        """
        The same for rotations, (M, T, 3, 3), on one time grid, times (T,) s.
        """
    @staticmethod
    def targets(demonstrations: collections.abc.Sequence[OrientationDemonstration], options: DmpOptions | None = None, **kwargs) -> list[ForcingTarget]:
        """
        What fit learns from: the forcing term along each demonstration, one ForcingTarget each.
        """
    def __getstate__(self) -> str:
        ...
    def __init__(self, parameters: OrientationDmpParameters) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    def activations(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], normalised: bool = False) -> numpy.typing.NDArray[numpy.float64]:
        """
        The kernels (T, N) at phases (T,); rows sum to 1 if normalised.
        """
    def forcing(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        The forcing term (T, dims) at phases (T,), 0 at the start and 1 at the end.
        """
    def rollout(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, dt: typing.SupportsFloat | typing.SupportsIndex = 0.001, via: collections.abc.Sequence[Via] = ()) -> OrientationTrajectory:
        """
        The motion from the demonstrated start to `goal` (shaped as the property goal; the demonstrated one unless given) within `duration` s (the demonstrated one unless given), at 0, dt, ... and the duration, the last step shorter where dt does not divide it. Raises InvalidArgument for a wrong shape, a number that is not finite or not positive, more than 10^7 samples, or a motion that does not stay finite. `via`: a list of Via that it passes, in the order of their phases.
        """
    def rollout_at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, via: collections.abc.Sequence[Via] = ()) -> OrientationTrajectory:
        """
        The same at times (T,) in s, increasing from 0 or later.
        """
    def rollout_each(self, goals: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, durations: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, samples: typing.SupportsInt | typing.SupportsIndex = 1001, threads: typing.SupportsInt | typing.SupportsIndex = 1) -> OrientationTrajectoryBatch:
        """
        One motion for each of M goals (M, ...) and durations (M,) s, T = `samples` of each, evenly from 0 to its duration: the same as rollout(goal, duration, duration / (samples - 1)). Without goals, or without durations, the demonstrated one for all. threads: 0 for as many as the machine runs at once. Raises InvalidArgument, naming the motion, as rollout does.
        """
    def scaling_notes(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> list[str]:
        """
        Where the guard of the scaling steps in on the way to `goal` (the demonstrated one unless given), a line for each axis; see DmpOptions.scaling_guard.
        """
    def with_scaling(self, scaling: typing.Any) -> OrientationDmp:
        """
        The same motion, led to new starts and goals by another Scaling, or its name. Of several demonstrations learned together it is the mean that is scaled. Raises InvalidArgument for an unknown one, or one that the form of orientations does not bear.
        """
    def with_weights(self, weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> OrientationDmp:
        """
        The same model with other weights (N, dims).
        """
    @property
    def basis(self) -> GaussianBasis:
        """
        The kernels of the forcing term.
        """
    @property
    def dimension(self) -> int:
        """
        axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        tau of the demonstration, s
        """
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3)
        """
    @property
    def options(self) -> DmpOptions:
        """
        A copy: what the model was learned with.
        """
    @property
    def parameters(self) -> OrientationDmpParameters:
        """
        A copy of all that the model is: change it and make another model.
        """
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3)
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, dims) of the forcing term; see with_weights
        """
class OrientationRunState:
    """
    What a coupling sees: the run at the start of an internal step.
    """
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        the one set last
        """
    @property
    def phase(self) -> float:
        """
        s, 0 at the start, 1 at the end
        """
    @property
    def point(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3)
        """
    @property
    def speed(self) -> float:
        """
        ds/dt as it is now, 1/s
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        per s; of rotations rad/s, world frame
        """
class OrientationRun:
    """
    One run of a OrientationDmp, for one control loop.
    """
    def __copy__(self) -> OrientationRun:
        ...
    def __deepcopy__(self, memo: dict) -> OrientationRun:
        ...
    def __init__(self, dmp: OrientationDmp) -> None:
        ...
    def ahead(self, phase: typing.SupportsFloat | typing.SupportsIndex) -> OrientationRunState:
        """
        Where the run will be at a phase from now to 1 if nothing changes until then, via-points included; speed and velocity at the duration that is set.
        """
    def clear_vias(self) -> None:
        """
        Forgets all via-points; what is under way fades within its reach.
        """
    @typing.overload
    def join(self, next: OrientationDmp, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> None:
        """
        Goes on with another motion from the present state: a model, or a run of one that stands where it shall begin, with its goal, duration and via-points set. Position, velocity and acceleration do not jump; what lies between the two motions fades within `reach`, a part of the phase of `next`.
        """
    @typing.overload
    def join(self, next: OrientationRun, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> None:
        ...
    def move_via(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Status:
        """
        The via-point that was set at `phase` has moved. Returns Status.running, or Status.too_late where it lies behind.
        """
    def pause(self) -> None:
        """
        Comes to rest on the path, through options.tempo_filter.
        """
    def reset(self) -> None:
        """
        Begins anew at the demonstrated start, with the goal and duration that were set last.
        """
    def resume(self) -> None:
        """
        Goes on from there.
        """
    def set_tracking_error(self, error: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        How far the robot lags behind: slows the phase by 1 + options.phase_stop times it.
        """
    @typing.overload
    def start_from(self, rotation: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        Begins anew at rotation (3, 3) with angular velocity (3,) rad/s, world frame.
        """
    @typing.overload
    def start_from(self, rotation: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex]) -> None:
        """
        Begins anew, from any point and velocity with no acceleration, and comes onto the learned motion within `reach`, a part of the phase: nothing jumps, and behind it nothing is changed.
        """
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex, coupling: collections.abc.Callable | None = None, filter: SafetyFilter = None) -> bool:
        """
        Moves on by dt seconds. True while the motion runs, False when it has finished; raises FloatingPointError when the state is not finite. `coupling(state)`, called in each internal step, returns what is added to the forcing term (d,): an acceleration divided by state.speed**2. Where it raises, the run stays as it was. `filter`, a SafetyFilter, changes where the run is so that limits are kept and obstacles not touched; status is Status.blocked where they leave no way on.
        """
    def via(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> Status:
        """
        Passes `point` (shaped as the property goal) at a phase that lies ahead, 0.01 to 0.99, and changes the motion within `reach` only, a part of the phase or one before and one behind: exactly, whatever happens to goal, duration or point until then. With `velocity` (d,) per s it has that there. Returns Status.running, or Status.too_late where less than 0.01 is left until there; raises InvalidArgument for what can be no via-point.
        """
    @property
    def amplitude(self) -> float:
        """
        what the forcing term is multiplied by, 1 at first: of a rhythmic motion what it goes away from its centre; approached as a goal is
        """
    @amplitude.setter
    def amplitude(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def angular_acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) rad/s^2, world frame
        """
    @property
    def angular_velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) rad/s, world frame
        """
    @property
    def duration(self) -> float:
        """
        s, of the whole motion from now on; the path stays the same
        """
    @duration.setter
    def duration(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3) the goal to go to from now on, approached through the goal filter
        """
    @goal.setter
    def goal(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    @property
    def paused(self) -> bool:
        ...
    @property
    def phase(self) -> float:
        """
        0 at the start, 1 at the end
        """
    @property
    def rotation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3) body -> world
        """
    @property
    def state(self) -> OrientationRunState:
        """
        where the run is: phase, speed, point, velocity and goal
        """
    @property
    def status(self) -> Status:
        ...
    @property
    def time(self) -> float:
        """
        s since the start
        """
class OrientationDmpSequence:
    """
    Motions one after another as one: each takes over where the one before is left, without a jump of position, velocity or acceleration. Immutable.
    """
    def __getstate__(self) -> str:
        ...
    def __init__(self, models: collections.abc.Sequence[OrientationDmp], leave: typing.SupportsFloat | typing.SupportsIndex | collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = 1.0, reach: typing.SupportsFloat | typing.SupportsIndex | collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = 0.2, via: collections.abc.Sequence[collections.abc.Sequence[Via]] = ()) -> None:
        """
        models: 1 to 32. leave: the phase of each at which the next one takes over, 0.01 to 1, or one for all; below 1 without coming to rest. reach: the part of the phase of each, 0.01 to 1, within which it is come onto from the one before. via: a list of Via for each model. Raises InvalidArgument, naming the part.
        """
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    def rollout(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, dt: typing.SupportsFloat | typing.SupportsIndex = 0.001) -> OrientationTrajectory:
        """
        The whole motion, to `goal` at its end, within `duration` s (all parts in proportion), as the rollout of a model.
        """
    def rollout_at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None) -> OrientationTrajectory:
        """
        The same at times (T,) in s, increasing from 0 or later.
        """
    @property
    def dimension(self) -> int:
        """
        axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        s, of all as demonstrated
        """
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3)
        """
    @property
    def leave(self) -> list[float]:
        ...
    @property
    def models(self) -> list[OrientationDmp]:
        ...
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3)
        """
class OrientationDmpSequenceRun:
    """
    One run of a sequence, for one control loop.
    """
    def __init__(self, sequence: OrientationDmpSequence) -> None:
        ...
    def set_goal(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        The goal of the last motion.
        """
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex) -> bool:
        """
        Moves on by dt seconds. True while the motion runs, False when it has finished.
        """
    def stretch(self, factor: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        All durations times `factor`, from now on.
        """
    @property
    def part(self) -> int:
        """
        which motion is under way, from 0
        """
    @property
    def phase(self) -> float:
        """
        of that motion
        """
    @property
    def state(self) -> OrientationRunState:
        """
        where the run is: point, velocity, phase and goal of the motion that is under way
        """
    @property
    def time(self) -> float:
        """
        s since the start
        """
class OrientationDistribution:
    """
    A probabilistic movement primitive for orientations on SO(3): a motion and how it varies, learned from several demonstrations. Immutable.
    """
    @staticmethod
    def fit(demonstrations: collections.abc.Sequence[OrientationDemonstration], *, control_points: typing.SupportsInt | typing.SupportsIndex = 14, prior: typing.SupportsFloat | typing.SupportsIndex = 8.0, iterations: typing.SupportsInt | typing.SupportsIndex = 20) -> OrientationDistribution:
        """
        Learns two or more demonstrations of one motion by expectation maximisation, each taken at t / its duration. control_points: of the cubic B-splines over the phase, 4 to 200; prior: weight of the inverse-Wishart prior, in demonstrations, 0.1 to 1000. Raises InvalidArgument, naming it, for a demonstration that does not belong to the others.
        """
    def __getstate__(self) -> str:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    @typing.overload
    def condition(self, given: collections.abc.Sequence[Given]) -> OrientationDistribution:
        """
        Of the motions that pass what is given: a list of Given, or a dict of points by their phases, which are passed exactly. Raises InvalidArgument, naming given[k], for phases, shapes or covariances out of range, and where nothing is left open: two exact points at one phase, or more of them than there are control points near by.
        """
    @typing.overload
    def condition(self, given: collections.abc.Mapping[typing.SupportsFloat | typing.SupportsIndex, typing.Any]) -> OrientationDistribution:
        ...
    def continued(self, part: OrientationDemonstration, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, phase: typing.SupportsFloat | typing.SupportsIndex = 0.0, noise: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> OrientationDistribution:
        """
        Of the motions that go on from a recording of their beginning, or of a part from `phase` on, at the pace of `duration` (s, of the whole motion; the mean one unless given). `noise` (parts,): standard deviation of a sample; unless given that of the demonstrations, with a share of the variance there. Raises InvalidArgument where the part does not lie within the motion.
        """
    def distance(self, given: Given) -> float:
        """
        How many standard deviations (Mahalanobis) what is given lies from the mean, noise included.
        """
    def log_likelihood(self, demonstration: OrientationDemonstration) -> float:
        """
        Logarithm of the density of a demonstration, taken at t / its duration: of all its numbers, in the units of the demonstrations.
        """
    def mean(self, options: DmpOptions | None = None, **kwargs) -> OrientationDmp:
        """
        The mean as a primitive; options as its fit takes them.
        """
    def observation_covariance(self, phase: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d, d) how far an observed motion may lie from what the weights can say at a phase: for `covariance` of what was measured and not wished for.
        """
    def rollout(self, samples: typing.SupportsInt | typing.SupportsIndex = 101) -> OrientationTrajectory:
        """
        The mean motion over `duration`, at `samples` even times.
        """
    def sample(self, seed: typing.SupportsInt | typing.SupportsIndex = 0, samples: typing.SupportsInt | typing.SupportsIndex = 101) -> OrientationTrajectory:
        """
        One motion drawn from it; the same for the same seed.
        """
    def spread(self, count: typing.SupportsInt | typing.SupportsIndex = 101) -> OrientationSpread:
        """
        Mean and covariance at `count` even phases, without the noise of samples; of rotations about the axes of the world.
        """
    def stiffness(self, phase: typing.SupportsFloat | typing.SupportsIndex, most: typing.SupportsFloat | typing.SupportsIndex | typing.Annotated[numpy.typing.ArrayLike, numpy.float64], spread: typing.SupportsFloat | typing.SupportsIndex | typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d, d) stiffness that is high where the demonstrations agree: no more than `most`, half of it where their standard deviation is `spread`. Both: a positive number, or (d,). Positive definite by construction; see damping_of.
        """
    @property
    def control_points(self) -> int:
        """
        N, of the splines over the phase
        """
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N * d, N * d) of the weights
        """
    @property
    def demonstrations(self) -> int:
        """
        how many it was learned from
        """
    @property
    def dimension(self) -> int:
        """
        d, axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        s, mean of the demonstrations
        """
    @property
    def noise(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (parts,) standard deviation of a sample, of vectors and of rotations [rad]
        """
    @property
    def reference(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, columns) the motion at even phases that the weights deviate from; rotations as w x y z
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N * d,) mean of the weights, those of one control point together
        """
class PoseDmpParameters:
    """
    All that a PoseDmp is: what a model file holds. Fields as keywords.
    """
    options: DmpOptions
    def __init__(self, **kwargs) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def advance(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @advance.setter
    def advance(self, arg1: typing.Any) -> None:
        ...
    @property
    def amplitude(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @amplitude.setter
    def amplitude(self, arg1: typing.Any) -> None:
        ...
    @property
    def duration(self) -> float:
        ...
    @duration.setter
    def duration(self, arg1: typing.Any) -> None:
        ...
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @goal.setter
    def goal(self, arg1: typing.Any) -> None:
        ...
    @property
    def reference(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @reference.setter
    def reference(self, arg1: typing.Any) -> None:
        ...
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @start.setter
    def start(self, arg1: typing.Any) -> None:
        ...
    @property
    def start_error(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @start_error.setter
    def start_error(self, arg1: typing.Any) -> None:
        ...
    @property
    def start_twist(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @start_twist.setter
    def start_twist(self, arg1: typing.Any) -> None:
        ...
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @weights.setter
    def weights(self, arg1: typing.Any) -> None:
        ...
class PoseTrajectoryBatch:
    """
    Many motions: what PoseDmp.rollout_each returns.
    """
    def __len__(self) -> int:
        ...
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, 6) the twist's rate, m/s^2 and rad/s^2
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, 4, 4) [R p; 0 1], body -> world
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T) s
        """
    @property
    def twist(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, 6) linear velocity of the origin [m/s], angular velocity [rad/s], world frame
        """
class PoseDmp:
    """
    A dynamic movement primitive for poses [R p; 0 1], position and orientation in one phase. Immutable.
    """
    @staticmethod
    @typing.overload
    def fit(demonstration: PoseDemonstration, options: DmpOptions | None = None, *, learner: collections.abc.Callable | None = None, **kwargs) -> PoseDmp:
        """
        Learns from a demonstration, or from a list of them together. `options` is a DmpOptions; its fields may be given as keywords too: fit(demonstration, basis_count=50, regression="ridge"). `learner(basis, targets)` returns the weights (N, dims) in place of the options' regression.
        """
    @staticmethod
    @typing.overload
    def fit(demonstrations: collections.abc.Sequence[PoseDemonstration], options: DmpOptions | None = None, *, learner: collections.abc.Callable | None = None, **kwargs) -> PoseDmp:
        ...
    @staticmethod
    @typing.overload
    def fit_each(demonstrations: collections.abc.Sequence[PoseDemonstration], options: DmpOptions | None = None, threads: typing.SupportsInt | typing.SupportsIndex = 1, **kwargs) -> list[PoseDmp]:
        """
        One model for each demonstration, the same as fit gives. threads: how many to use, 0 for as many as the machine runs at once. Options as in fit.
        """
    @staticmethod
    @typing.overload
    def fit_each(times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], poses: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], options: DmpOptions | None = None, threads: typing.SupportsInt | typing.SupportsIndex = 1, **kwargs) -> list[PoseDmp]:
        """
        The same for poses, (M, T, 4, 4), on one time grid, times (T,) s.
        """
    @staticmethod
    def targets(demonstrations: collections.abc.Sequence[PoseDemonstration], options: DmpOptions | None = None, **kwargs) -> list[ForcingTarget]:
        """
        What fit learns from: the forcing term along each demonstration, one ForcingTarget each.
        """
    def __getstate__(self) -> str:
        ...
    def __init__(self, parameters: PoseDmpParameters) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    def activations(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], normalised: bool = False) -> numpy.typing.NDArray[numpy.float64]:
        """
        The kernels (T, N) at phases (T,); rows sum to 1 if normalised.
        """
    def forcing(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        The forcing term (T, dims) at phases (T,), 0 at the start and 1 at the end.
        """
    def rollout(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, dt: typing.SupportsFloat | typing.SupportsIndex = 0.001, via: collections.abc.Sequence[Via] = ()) -> PoseTrajectory:
        """
        The motion from the demonstrated start to `goal` (shaped as the property goal; the demonstrated one unless given) within `duration` s (the demonstrated one unless given), at 0, dt, ... and the duration, the last step shorter where dt does not divide it. Raises InvalidArgument for a wrong shape, a number that is not finite or not positive, more than 10^7 samples, or a motion that does not stay finite. `via`: a list of Via that it passes, in the order of their phases.
        """
    def rollout_at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, via: collections.abc.Sequence[Via] = ()) -> PoseTrajectory:
        """
        The same at times (T,) in s, increasing from 0 or later.
        """
    def rollout_each(self, goals: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, durations: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, samples: typing.SupportsInt | typing.SupportsIndex = 1001, threads: typing.SupportsInt | typing.SupportsIndex = 1) -> PoseTrajectoryBatch:
        """
        One motion for each of M goals (M, ...) and durations (M,) s, T = `samples` of each, evenly from 0 to its duration: the same as rollout(goal, duration, duration / (samples - 1)). Without goals, or without durations, the demonstrated one for all. threads: 0 for as many as the machine runs at once. Raises InvalidArgument, naming the motion, as rollout does.
        """
    def scaling_notes(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> list[str]:
        """
        Where the guard of the scaling steps in on the way to `goal` (the demonstrated one unless given), a line for each axis; see DmpOptions.scaling_guard.
        """
    def with_scaling(self, scaling: typing.Any) -> PoseDmp:
        """
        The same motion, led to new starts and goals by another Scaling, or its name. Of several demonstrations learned together it is the mean that is scaled. Raises InvalidArgument for an unknown one, or one that the form of orientations does not bear.
        """
    def with_weights(self, weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> PoseDmp:
        """
        The same model with other weights (N, dims).
        """
    @property
    def basis(self) -> GaussianBasis:
        """
        The kernels of the forcing term.
        """
    @property
    def dimension(self) -> int:
        """
        axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        tau of the demonstration, s
        """
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4)
        """
    @property
    def options(self) -> DmpOptions:
        """
        A copy: what the model was learned with.
        """
    @property
    def parameters(self) -> PoseDmpParameters:
        """
        A copy of all that the model is: change it and make another model.
        """
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4)
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, dims) of the forcing term; see with_weights
        """
class PoseRunState:
    """
    What a coupling sees: the run at the start of an internal step.
    """
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        the one set last
        """
    @property
    def phase(self) -> float:
        """
        s, 0 at the start, 1 at the end
        """
    @property
    def point(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4)
        """
    @property
    def speed(self) -> float:
        """
        ds/dt as it is now, 1/s
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        per s; of rotations rad/s, world frame
        """
class PoseRun:
    """
    One run of a PoseDmp, for one control loop.
    """
    def __copy__(self) -> PoseRun:
        ...
    def __deepcopy__(self, memo: dict) -> PoseRun:
        ...
    def __init__(self, dmp: PoseDmp) -> None:
        ...
    def ahead(self, phase: typing.SupportsFloat | typing.SupportsIndex) -> PoseRunState:
        """
        Where the run will be at a phase from now to 1 if nothing changes until then, via-points included; speed and velocity at the duration that is set.
        """
    def clear_vias(self) -> None:
        """
        Forgets all via-points; what is under way fades within its reach.
        """
    @typing.overload
    def join(self, next: PoseDmp, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> None:
        """
        Goes on with another motion from the present state: a model, or a run of one that stands where it shall begin, with its goal, duration and via-points set. Position, velocity and acceleration do not jump; what lies between the two motions fades within `reach`, a part of the phase of `next`.
        """
    @typing.overload
    def join(self, next: PoseRun, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> None:
        ...
    def move_via(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Status:
        """
        The via-point that was set at `phase` has moved. Returns Status.running, or Status.too_late where it lies behind.
        """
    def pause(self) -> None:
        """
        Comes to rest on the path, through options.tempo_filter.
        """
    def reset(self) -> None:
        """
        Begins anew at the demonstrated start, with the goal and duration that were set last.
        """
    def resume(self) -> None:
        """
        Goes on from there.
        """
    def set_tracking_error(self, error: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        How far the robot lags behind: slows the phase by 1 + options.phase_stop times it.
        """
    @typing.overload
    def start_from(self, pose: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], twist: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        Begins anew at pose (4, 4) with twist (6,) m/s, rad/s.
        """
    @typing.overload
    def start_from(self, pose: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], twist: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex]) -> None:
        """
        Begins anew, from any point and velocity with no acceleration, and comes onto the learned motion within `reach`, a part of the phase: nothing jumps, and behind it nothing is changed.
        """
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex, coupling: collections.abc.Callable | None = None, filter: SafetyFilter = None) -> bool:
        """
        Moves on by dt seconds. True while the motion runs, False when it has finished; raises FloatingPointError when the state is not finite. `coupling(state)`, called in each internal step, returns what is added to the forcing term (d,): an acceleration divided by state.speed**2. Where it raises, the run stays as it was. `filter`, a SafetyFilter, changes where the run is so that limits are kept and obstacles not touched; status is Status.blocked where they leave no way on.
        """
    def via(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> Status:
        """
        Passes `point` (shaped as the property goal) at a phase that lies ahead, 0.01 to 0.99, and changes the motion within `reach` only, a part of the phase or one before and one behind: exactly, whatever happens to goal, duration or point until then. With `velocity` (d,) per s it has that there. Returns Status.running, or Status.too_late where less than 0.01 is left until there; raises InvalidArgument for what can be no via-point.
        """
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6,) m/s^2, rad/s^2, world frame
        """
    @property
    def amplitude(self) -> float:
        """
        what the forcing term is multiplied by, 1 at first: of a rhythmic motion what it goes away from its centre; approached as a goal is
        """
    @amplitude.setter
    def amplitude(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def duration(self) -> float:
        """
        s, of the whole motion from now on; the path stays the same
        """
    @duration.setter
    def duration(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4) the goal to go to from now on, approached through the goal filter
        """
    @goal.setter
    def goal(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    @property
    def paused(self) -> bool:
        ...
    @property
    def phase(self) -> float:
        """
        0 at the start, 1 at the end
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4) [R p; 0 1]
        """
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m
        """
    @property
    def rotation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3)
        """
    @property
    def state(self) -> PoseRunState:
        """
        where the run is: phase, speed, point, velocity and goal
        """
    @property
    def status(self) -> Status:
        ...
    @property
    def time(self) -> float:
        """
        s since the start
        """
    @property
    def twist(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6,) linear velocity of the origin [m/s], angular velocity [rad/s], world frame
        """
class PoseDmpSequence:
    """
    Motions one after another as one: each takes over where the one before is left, without a jump of position, velocity or acceleration. Immutable.
    """
    def __getstate__(self) -> str:
        ...
    def __init__(self, models: collections.abc.Sequence[PoseDmp], leave: typing.SupportsFloat | typing.SupportsIndex | collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = 1.0, reach: typing.SupportsFloat | typing.SupportsIndex | collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = 0.2, via: collections.abc.Sequence[collections.abc.Sequence[Via]] = ()) -> None:
        """
        models: 1 to 32. leave: the phase of each at which the next one takes over, 0.01 to 1, or one for all; below 1 without coming to rest. reach: the part of the phase of each, 0.01 to 1, within which it is come onto from the one before. via: a list of Via for each model. Raises InvalidArgument, naming the part.
        """
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    def rollout(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, dt: typing.SupportsFloat | typing.SupportsIndex = 0.001) -> PoseTrajectory:
        """
        The whole motion, to `goal` at its end, within `duration` s (all parts in proportion), as the rollout of a model.
        """
    def rollout_at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None) -> PoseTrajectory:
        """
        The same at times (T,) in s, increasing from 0 or later.
        """
    @property
    def dimension(self) -> int:
        """
        axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        s, of all as demonstrated
        """
    @property
    def goal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4)
        """
    @property
    def leave(self) -> list[float]:
        ...
    @property
    def models(self) -> list[PoseDmp]:
        ...
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4)
        """
class PoseDmpSequenceRun:
    """
    One run of a sequence, for one control loop.
    """
    def __init__(self, sequence: PoseDmpSequence) -> None:
        ...
    def set_goal(self, goal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        The goal of the last motion.
        """
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex) -> bool:
        """
        Moves on by dt seconds. True while the motion runs, False when it has finished.
        """
    def stretch(self, factor: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        All durations times `factor`, from now on.
        """
    @property
    def part(self) -> int:
        """
        which motion is under way, from 0
        """
    @property
    def phase(self) -> float:
        """
        of that motion
        """
    @property
    def state(self) -> PoseRunState:
        """
        where the run is: point, velocity, phase and goal of the motion that is under way
        """
    @property
    def time(self) -> float:
        """
        s since the start
        """
class PoseDistribution:
    """
    A probabilistic movement primitive for poses [R p; 0 1], position and orientation in one phase: a motion and how it varies, learned from several demonstrations. Immutable.
    """
    @staticmethod
    def fit(demonstrations: collections.abc.Sequence[PoseDemonstration], *, control_points: typing.SupportsInt | typing.SupportsIndex = 14, prior: typing.SupportsFloat | typing.SupportsIndex = 8.0, iterations: typing.SupportsInt | typing.SupportsIndex = 20) -> PoseDistribution:
        """
        Learns two or more demonstrations of one motion by expectation maximisation, each taken at t / its duration. control_points: of the cubic B-splines over the phase, 4 to 200; prior: weight of the inverse-Wishart prior, in demonstrations, 0.1 to 1000. Raises InvalidArgument, naming it, for a demonstration that does not belong to the others.
        """
    def __getstate__(self) -> str:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    @typing.overload
    def condition(self, given: collections.abc.Sequence[Given]) -> PoseDistribution:
        """
        Of the motions that pass what is given: a list of Given, or a dict of points by their phases, which are passed exactly. Raises InvalidArgument, naming given[k], for phases, shapes or covariances out of range, and where nothing is left open: two exact points at one phase, or more of them than there are control points near by.
        """
    @typing.overload
    def condition(self, given: collections.abc.Mapping[typing.SupportsFloat | typing.SupportsIndex, typing.Any]) -> PoseDistribution:
        ...
    def continued(self, part: PoseDemonstration, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, phase: typing.SupportsFloat | typing.SupportsIndex = 0.0, noise: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> PoseDistribution:
        """
        Of the motions that go on from a recording of their beginning, or of a part from `phase` on, at the pace of `duration` (s, of the whole motion; the mean one unless given). `noise` (parts,): standard deviation of a sample; unless given that of the demonstrations, with a share of the variance there. Raises InvalidArgument where the part does not lie within the motion.
        """
    def distance(self, given: Given) -> float:
        """
        How many standard deviations (Mahalanobis) what is given lies from the mean, noise included.
        """
    def log_likelihood(self, demonstration: PoseDemonstration) -> float:
        """
        Logarithm of the density of a demonstration, taken at t / its duration: of all its numbers, in the units of the demonstrations.
        """
    def mean(self, options: DmpOptions | None = None, **kwargs) -> PoseDmp:
        """
        The mean as a primitive; options as its fit takes them.
        """
    def observation_covariance(self, phase: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d, d) how far an observed motion may lie from what the weights can say at a phase: for `covariance` of what was measured and not wished for.
        """
    def rollout(self, samples: typing.SupportsInt | typing.SupportsIndex = 101) -> PoseTrajectory:
        """
        The mean motion over `duration`, at `samples` even times.
        """
    def sample(self, seed: typing.SupportsInt | typing.SupportsIndex = 0, samples: typing.SupportsInt | typing.SupportsIndex = 101) -> PoseTrajectory:
        """
        One motion drawn from it; the same for the same seed.
        """
    def spread(self, count: typing.SupportsInt | typing.SupportsIndex = 101) -> PoseSpread:
        """
        Mean and covariance at `count` even phases, without the noise of samples; of rotations about the axes of the world.
        """
    def stiffness(self, phase: typing.SupportsFloat | typing.SupportsIndex, most: typing.SupportsFloat | typing.SupportsIndex | typing.Annotated[numpy.typing.ArrayLike, numpy.float64], spread: typing.SupportsFloat | typing.SupportsIndex | typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d, d) stiffness that is high where the demonstrations agree: no more than `most`, half of it where their standard deviation is `spread`. Both: a positive number, or (d,). Positive definite by construction; see damping_of.
        """
    @property
    def control_points(self) -> int:
        """
        N, of the splines over the phase
        """
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N * d, N * d) of the weights
        """
    @property
    def demonstrations(self) -> int:
        """
        how many it was learned from
        """
    @property
    def dimension(self) -> int:
        """
        d, axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        s, mean of the demonstrations
        """
    @property
    def noise(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (parts,) standard deviation of a sample, of vectors and of rotations [rad]
        """
    @property
    def reference(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, columns) the motion at even phases that the weights deviate from; rotations as w x y z
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N * d,) mean of the weights, those of one control point together
        """
class PoseGripperTrajectory:
    """
    A motion over time: what PoseGripperDmp.rollout returns.
    """
    def __getstate__(self) -> tuple:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 6) the twist's rate, m/s^2 and rad/s^2
        """
    @property
    def gripper(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, d)
        """
    @property
    def gripper_acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, d) per s^2
        """
    @property
    def gripper_velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, d) per s
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 4, 4) [R p; 0 1], body -> world
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s
        """
    @property
    def twist(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, 6) linear velocity of the origin [m/s], angular velocity [rad/s], world frame
        """
class PoseGripperDemonstration:
    """
    The pose of a tool and its gripper as they were recorded.
    """
    def __init__(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], poses: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], gripper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        times (T,) s, strictly increasing; poses (T, 4, 4) [R p; 0 1], body -> world, p in m; gripper (T,) or (T, k): its opening, or the joints of a hand. Raises InvalidArgument naming the sample.
        """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def duration(self) -> float:
        """
        s
        """
    @property
    def gripper(self) -> Demonstration:
        """
        a Demonstration
        """
    @property
    def pose(self) -> PoseDemonstration:
        """
        a PoseDemonstration
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s, from 0
        """
class PoseGripperDmpParameters:
    """
    All that a PoseGripperDmp is: what a model file holds. Fields as keywords.
    """
    options: DmpOptions
    def __init__(self, **kwargs) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def advance(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @advance.setter
    def advance(self, arg1: typing.Any) -> None:
        ...
    @property
    def amplitude(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @amplitude.setter
    def amplitude(self, arg1: typing.Any) -> None:
        ...
    @property
    def displacement(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @displacement.setter
    def displacement(self, arg1: typing.Any) -> None:
        ...
    @property
    def duration(self) -> float:
        ...
    @duration.setter
    def duration(self, arg1: typing.Any) -> None:
        ...
    @property
    def goal(self) -> tuple:
        ...
    @goal.setter
    def goal(self, arg1: typing.Any) -> None:
        ...
    @property
    def reference(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @reference.setter
    def reference(self, arg1: typing.Any) -> None:
        ...
    @property
    def start(self) -> tuple:
        ...
    @start.setter
    def start(self, arg1: typing.Any) -> None:
        ...
    @property
    def start_velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @start_velocity.setter
    def start_velocity(self, arg1: typing.Any) -> None:
        ...
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @weights.setter
    def weights(self, arg1: typing.Any) -> None:
        ...
class PoseGripperTrajectoryBatch:
    """
    Many motions: what PoseGripperDmp.rollout_each returns.
    """
    def __len__(self) -> int:
        ...
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, 6) the twist's rate, m/s^2 and rad/s^2
        """
    @property
    def gripper(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, d)
        """
    @property
    def gripper_acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, d) per s^2
        """
    @property
    def gripper_velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, d) per s
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, 4, 4) [R p; 0 1], body -> world
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T) s
        """
    @property
    def twist(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (M, T, 6) linear velocity of the origin [m/s], angular velocity [rad/s], world frame
        """
class PoseGripperDmp:
    """
    A dynamic movement primitive for the pose of a tool and its gripper, in one phase. Immutable.
    """
    @staticmethod
    @typing.overload
    def fit(demonstration: PoseGripperDemonstration, options: DmpOptions | None = None, *, learner: collections.abc.Callable | None = None, **kwargs) -> PoseGripperDmp:
        """
        Learns from a demonstration, or from a list of them together. `options` is a DmpOptions; its fields may be given as keywords too: fit(demonstration, basis_count=50, regression="ridge"). `learner(basis, targets)` returns the weights (N, dims) in place of the options' regression.
        """
    @staticmethod
    @typing.overload
    def fit(demonstrations: collections.abc.Sequence[PoseGripperDemonstration], options: DmpOptions | None = None, *, learner: collections.abc.Callable | None = None, **kwargs) -> PoseGripperDmp:
        ...
    @staticmethod
    @typing.overload
    def fit_each(demonstrations: collections.abc.Sequence[PoseGripperDemonstration], options: DmpOptions | None = None, threads: typing.SupportsInt | typing.SupportsIndex = 1, **kwargs) -> list[PoseGripperDmp]:
        """
        One model for each demonstration, the same as fit gives. threads: how many to use, 0 for as many as the machine runs at once. Options as in fit.
        """
    @staticmethod
    @typing.overload
    def fit_each(times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], paths: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], options: DmpOptions | None = None, threads: typing.SupportsInt | typing.SupportsIndex = 1, **kwargs) -> list[PoseGripperDmp]:
        """
        The same for paths, a tuple (poses (M, T, 4, 4), grippers (M, T, k)), on one time grid, times (T,) s.
        """
    @staticmethod
    def targets(demonstrations: collections.abc.Sequence[PoseGripperDemonstration], options: DmpOptions | None = None, **kwargs) -> list[ForcingTarget]:
        """
        What fit learns from: the forcing term along each demonstration, one ForcingTarget each.
        """
    def __getstate__(self) -> str:
        ...
    def __init__(self, parameters: PoseGripperDmpParameters) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    def activations(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], normalised: bool = False) -> numpy.typing.NDArray[numpy.float64]:
        """
        The kernels (T, N) at phases (T,); rows sum to 1 if normalised.
        """
    def forcing(self, phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        The forcing term (T, dims) at phases (T,), 0 at the start and 1 at the end.
        """
    def rollout(self, goal: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, dt: typing.SupportsFloat | typing.SupportsIndex = 0.001, via: collections.abc.Sequence[Via] = ()) -> PoseGripperTrajectory:
        """
        The motion from the demonstrated start to `goal` (shaped as the property goal; the demonstrated one unless given) within `duration` s (the demonstrated one unless given), at 0, dt, ... and the duration, the last step shorter where dt does not divide it. Raises InvalidArgument for a wrong shape, a number that is not finite or not positive, more than 10^7 samples, or a motion that does not stay finite. `via`: a list of Via that it passes, in the order of their phases.
        """
    def rollout_at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], goal: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, via: collections.abc.Sequence[Via] = ()) -> PoseGripperTrajectory:
        """
        The same at times (T,) in s, increasing from 0 or later.
        """
    def rollout_each(self, goals: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]] | None = None, durations: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, samples: typing.SupportsInt | typing.SupportsIndex = 1001, threads: typing.SupportsInt | typing.SupportsIndex = 1) -> PoseGripperTrajectoryBatch:
        """
        One motion for each of M goals (M, ...) and durations (M,) s, T = `samples` of each, evenly from 0 to its duration: the same as rollout(goal, duration, duration / (samples - 1)). Without goals, or without durations, the demonstrated one for all. threads: 0 for as many as the machine runs at once. Raises InvalidArgument, naming the motion, as rollout does.
        """
    def scaling_notes(self, goal: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]] | None = None) -> list[str]:
        """
        Where the guard of the scaling steps in on the way to `goal` (the demonstrated one unless given), a line for each axis; see DmpOptions.scaling_guard.
        """
    def with_scaling(self, scaling: typing.Any) -> PoseGripperDmp:
        """
        The same motion, led to new starts and goals by another Scaling, or its name. Of several demonstrations learned together it is the mean that is scaled. Raises InvalidArgument for an unknown one, or one that the form of orientations does not bear.
        """
    def with_weights(self, weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> PoseGripperDmp:
        """
        The same model with other weights (N, dims).
        """
    @property
    def basis(self) -> GaussianBasis:
        """
        The kernels of the forcing term.
        """
    @property
    def dimension(self) -> int:
        """
        axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        tau of the demonstration, s
        """
    @property
    def goal(self) -> tuple:
        """
        a tuple (pose (4, 4), gripper (k,))
        """
    @property
    def options(self) -> DmpOptions:
        """
        A copy: what the model was learned with.
        """
    @property
    def parameters(self) -> PoseGripperDmpParameters:
        """
        A copy of all that the model is: change it and make another model.
        """
    @property
    def start(self) -> tuple:
        """
        a tuple (pose (4, 4), gripper (k,))
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, dims) of the forcing term; see with_weights
        """
class PoseGripperRunState:
    """
    What a coupling sees: the run at the start of an internal step.
    """
    @property
    def goal(self) -> tuple:
        """
        the one set last
        """
    @property
    def phase(self) -> float:
        """
        s, 0 at the start, 1 at the end
        """
    @property
    def point(self) -> tuple:
        """
        a tuple (pose (4, 4), gripper (k,))
        """
    @property
    def speed(self) -> float:
        """
        ds/dt as it is now, 1/s
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        per s; of rotations rad/s, world frame
        """
class PoseGripperRun:
    """
    One run of a PoseGripperDmp, for one control loop.
    """
    def __copy__(self) -> PoseGripperRun:
        ...
    def __deepcopy__(self, memo: dict) -> PoseGripperRun:
        ...
    def __init__(self, dmp: PoseGripperDmp) -> None:
        ...
    def ahead(self, phase: typing.SupportsFloat | typing.SupportsIndex) -> PoseGripperRunState:
        """
        Where the run will be at a phase from now to 1 if nothing changes until then, via-points included; speed and velocity at the duration that is set.
        """
    def clear_vias(self) -> None:
        """
        Forgets all via-points; what is under way fades within its reach.
        """
    @typing.overload
    def join(self, next: PoseGripperDmp, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> None:
        """
        Goes on with another motion from the present state: a model, or a run of one that stands where it shall begin, with its goal, duration and via-points set. Position, velocity and acceleration do not jump; what lies between the two motions fades within `reach`, a part of the phase of `next`.
        """
    @typing.overload
    def join(self, next: PoseGripperRun, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> None:
        ...
    def move_via(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]]) -> Status:
        """
        The via-point that was set at `phase` has moved. Returns Status.running, or Status.too_late where it lies behind.
        """
    def pause(self) -> None:
        """
        Comes to rest on the path, through options.tempo_filter.
        """
    def reset(self) -> None:
        """
        Begins anew at the demonstrated start, with the goal and duration that were set last.
        """
    def resume(self) -> None:
        """
        Goes on from there.
        """
    def set_tracking_error(self, error: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        How far the robot lags behind: slows the phase by 1 + options.phase_stop times it.
        """
    @typing.overload
    def start_from(self, start: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        Begins anew at (pose, gripper) with velocity (6 + k,): twist, gripper per s.
        """
    @typing.overload
    def start_from(self, start: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex]) -> None:
        """
        Begins anew, from any point and velocity with no acceleration, and comes onto the learned motion within `reach`, a part of the phase: nothing jumps, and behind it nothing is changed.
        """
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex, coupling: collections.abc.Callable | None = None, filter: SafetyFilter = None) -> bool:
        """
        Moves on by dt seconds. True while the motion runs, False when it has finished; raises FloatingPointError when the state is not finite. `coupling(state)`, called in each internal step, returns what is added to the forcing term (d,): an acceleration divided by state.speed**2. Where it raises, the run stays as it was. `filter`, a SafetyFilter, changes where the run is so that limits are kept and obstacles not touched; status is Status.blocked where they leave no way on.
        """
    def via(self, phase: typing.SupportsFloat | typing.SupportsIndex, point: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, reach: typing.SupportsFloat | typing.SupportsIndex | tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = 0.2) -> Status:
        """
        Passes `point` (shaped as the property goal) at a phase that lies ahead, 0.01 to 0.99, and changes the motion within `reach` only, a part of the phase or one before and one behind: exactly, whatever happens to goal, duration or point until then. With `velocity` (d,) per s it has that there. Returns Status.running, or Status.too_late where less than 0.01 is left until there; raises InvalidArgument for what can be no via-point.
        """
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6,) m/s^2, rad/s^2, world frame
        """
    @property
    def amplitude(self) -> float:
        """
        what the forcing term is multiplied by, 1 at first: of a rhythmic motion what it goes away from its centre; approached as a goal is
        """
    @amplitude.setter
    def amplitude(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def duration(self) -> float:
        """
        s, of the whole motion from now on; the path stays the same
        """
    @duration.setter
    def duration(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def goal(self) -> tuple:
        """
        a tuple (pose (4, 4), gripper (k,)) the goal to go to from now on, approached through the goal filter
        """
    @goal.setter
    def goal(self, arg1: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]]) -> None:
        ...
    @property
    def gripper(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (k,)
        """
    @property
    def gripper_velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (k,) per s
        """
    @property
    def paused(self) -> bool:
        ...
    @property
    def phase(self) -> float:
        """
        0 at the start, 1 at the end
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4) [R p; 0 1]
        """
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m
        """
    @property
    def rotation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3)
        """
    @property
    def state(self) -> PoseGripperRunState:
        """
        where the run is: phase, speed, point, velocity and goal
        """
    @property
    def status(self) -> Status:
        ...
    @property
    def time(self) -> float:
        """
        s since the start
        """
    @property
    def twist(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6,) linear velocity of the origin [m/s], angular velocity [rad/s], world frame
        """
class PoseGripperDmpSequence:
    """
    Motions one after another as one: each takes over where the one before is left, without a jump of position, velocity or acceleration. Immutable.
    """
    def __getstate__(self) -> str:
        ...
    def __init__(self, models: collections.abc.Sequence[PoseGripperDmp], leave: typing.SupportsFloat | typing.SupportsIndex | collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = 1.0, reach: typing.SupportsFloat | typing.SupportsIndex | collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = 0.2, via: collections.abc.Sequence[collections.abc.Sequence[Via]] = ()) -> None:
        """
        models: 1 to 32. leave: the phase of each at which the next one takes over, 0.01 to 1, or one for all; below 1 without coming to rest. reach: the part of the phase of each, 0.01 to 1, within which it is come onto from the one before. via: a list of Via for each model. Raises InvalidArgument, naming the part.
        """
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    def rollout(self, goal: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, dt: typing.SupportsFloat | typing.SupportsIndex = 0.001) -> PoseGripperTrajectory:
        """
        The whole motion, to `goal` at its end, within `duration` s (all parts in proportion), as the rollout of a model.
        """
    def rollout_at(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], goal: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]] | None = None, duration: typing.SupportsFloat | typing.SupportsIndex | None = None) -> PoseGripperTrajectory:
        """
        The same at times (T,) in s, increasing from 0 or later.
        """
    @property
    def dimension(self) -> int:
        """
        axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        s, of all as demonstrated
        """
    @property
    def goal(self) -> tuple:
        """
        a tuple (pose (4, 4), gripper (k,))
        """
    @property
    def leave(self) -> list[float]:
        ...
    @property
    def models(self) -> list[PoseGripperDmp]:
        ...
    @property
    def start(self) -> tuple:
        """
        a tuple (pose (4, 4), gripper (k,))
        """
class PoseGripperDmpSequenceRun:
    """
    One run of a sequence, for one control loop.
    """
    def __init__(self, sequence: PoseGripperDmpSequence) -> None:
        ...
    def set_goal(self, goal: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]]) -> None:
        """
        The goal of the last motion.
        """
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex) -> bool:
        """
        Moves on by dt seconds. True while the motion runs, False when it has finished.
        """
    def stretch(self, factor: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        All durations times `factor`, from now on.
        """
    @property
    def part(self) -> int:
        """
        which motion is under way, from 0
        """
    @property
    def phase(self) -> float:
        """
        of that motion
        """
    @property
    def state(self) -> PoseGripperRunState:
        """
        where the run is: point, velocity, phase and goal of the motion that is under way
        """
    @property
    def time(self) -> float:
        """
        s since the start
        """
class PoseGripperDistribution:
    """
    A probabilistic movement primitive for the pose of a tool and its gripper, in one phase: a motion and how it varies, learned from several demonstrations. Immutable.
    """
    @staticmethod
    def fit(demonstrations: collections.abc.Sequence[PoseGripperDemonstration], *, control_points: typing.SupportsInt | typing.SupportsIndex = 14, prior: typing.SupportsFloat | typing.SupportsIndex = 8.0, iterations: typing.SupportsInt | typing.SupportsIndex = 20) -> PoseGripperDistribution:
        """
        Learns two or more demonstrations of one motion by expectation maximisation, each taken at t / its duration. control_points: of the cubic B-splines over the phase, 4 to 200; prior: weight of the inverse-Wishart prior, in demonstrations, 0.1 to 1000. Raises InvalidArgument, naming it, for a demonstration that does not belong to the others.
        """
    def __getstate__(self) -> str:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: str) -> None:
        ...
    @typing.overload
    def condition(self, given: collections.abc.Sequence[Given]) -> PoseGripperDistribution:
        """
        Of the motions that pass what is given: a list of Given, or a dict of points by their phases, which are passed exactly. Raises InvalidArgument, naming given[k], for phases, shapes or covariances out of range, and where nothing is left open: two exact points at one phase, or more of them than there are control points near by.
        """
    @typing.overload
    def condition(self, given: collections.abc.Mapping[typing.SupportsFloat | typing.SupportsIndex, typing.Any]) -> PoseGripperDistribution:
        ...
    def continued(self, part: PoseGripperDemonstration, duration: typing.SupportsFloat | typing.SupportsIndex | None = None, phase: typing.SupportsFloat | typing.SupportsIndex = 0.0, noise: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> PoseGripperDistribution:
        """
        Of the motions that go on from a recording of their beginning, or of a part from `phase` on, at the pace of `duration` (s, of the whole motion; the mean one unless given). `noise` (parts,): standard deviation of a sample; unless given that of the demonstrations, with a share of the variance there. Raises InvalidArgument where the part does not lie within the motion.
        """
    def distance(self, given: Given) -> float:
        """
        How many standard deviations (Mahalanobis) what is given lies from the mean, noise included.
        """
    def log_likelihood(self, demonstration: PoseGripperDemonstration) -> float:
        """
        Logarithm of the density of a demonstration, taken at t / its duration: of all its numbers, in the units of the demonstrations.
        """
    def mean(self, options: DmpOptions | None = None, **kwargs) -> PoseGripperDmp:
        """
        The mean as a primitive; options as its fit takes them.
        """
    def observation_covariance(self, phase: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d, d) how far an observed motion may lie from what the weights can say at a phase: for `covariance` of what was measured and not wished for.
        """
    def rollout(self, samples: typing.SupportsInt | typing.SupportsIndex = 101) -> PoseGripperTrajectory:
        """
        The mean motion over `duration`, at `samples` even times.
        """
    def sample(self, seed: typing.SupportsInt | typing.SupportsIndex = 0, samples: typing.SupportsInt | typing.SupportsIndex = 101) -> PoseGripperTrajectory:
        """
        One motion drawn from it; the same for the same seed.
        """
    def stiffness(self, phase: typing.SupportsFloat | typing.SupportsIndex, most: typing.SupportsFloat | typing.SupportsIndex | typing.Annotated[numpy.typing.ArrayLike, numpy.float64], spread: typing.SupportsFloat | typing.SupportsIndex | typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (d, d) stiffness that is high where the demonstrations agree: no more than `most`, half of it where their standard deviation is `spread`. Both: a positive number, or (d,). Positive definite by construction; see damping_of.
        """
    @property
    def control_points(self) -> int:
        """
        N, of the splines over the phase
        """
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N * d, N * d) of the weights
        """
    @property
    def demonstrations(self) -> int:
        """
        how many it was learned from
        """
    @property
    def dimension(self) -> int:
        """
        d, axes of the motion
        """
    @property
    def duration(self) -> float:
        """
        s, mean of the demonstrations
        """
    @property
    def noise(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (parts,) standard deviation of a sample, of vectors and of rotations [rad]
        """
    @property
    def reference(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (K, columns) the motion at even phases that the weights deviate from; rotations as w x y z
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N * d,) mean of the weights, those of one control point together
        """
class Alignment:
    """
    Which samples of two motions belong together.
    """
    def __len__(self) -> int:
        ...
    @property
    def distance(self) -> float:
        """
        sum over the path of the distances of its pairs; divide by len(path) for the mean
        """
    @property
    def path(self) -> numpy.typing.NDArray[numpy.int64]:
        """
        (K, 2) indices into the first and the second, from the first of both to the last of both; each row goes on by one sample in one motion or in both
        """
class LimitSource(enum.Enum):
    """
    Where a joint limit comes from.
    """
    assumed: typing.ClassVar[LimitSource]
    maker: typing.ClassVar[LimitSource]
    unstated: typing.ClassVar[LimitSource]
    urdf: typing.ClassVar[LimitSource]
    user: typing.ClassVar[LimitSource]
    @classmethod
    def __new__(cls, value):
        ...
class Arm:
    """
    The serial chain of n free joints from the link `base` to the link `tip` of a robot.
    
    An immutable value that any number of threads may use. Fixed joints are folded away, mimic joints move with their
    master. Radians for turning joints, metres for sliding ones; poses are tip in base.
    """
    @staticmethod
    def from_urdf(text: str, base: str = '', tip: str = '', folder: str = '') -> Arm:
        """
        Read a URDF; base "" is the root link, tip "" the tool at the end of the longest chain of arm joints.
        
        No gripper's joint is an arm's; frames named tcp, tool0, grasp, end_effector, tool or hand are preferred. `choice` says
        what was taken. `folder` is where mesh paths are relative to.
        
        Raises InvalidArgument, naming the joint or link, for a URDF with which no motion can be planned.
        """
    @staticmethod
    def from_urdf_file(path: os.PathLike | str | bytes, base: str = '', tip: str = '') -> Arm:
        """
        Read a URDF from a file and keep its folder. Raises FileError if it cannot be read.
        """
    def __getstate__(self) -> tuple:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def forward_kinematics(self, q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Pose of the tip (4, 4) at joints (n,), or poses (T, 4, 4) at joints (T, n), by KDL.
        """
    def gravity_effort(self, q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        N m or N that hold the arm still at joints (n,), or (T, n) at joints (T, n), by KDL.
        """
    def inverse_dynamics(self, q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], acceleration: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) N m or N for an acceleration (n,) at joints q (n,) that move with velocity (n,), by KDL.
        
        Recursive Newton-Euler under `gravity` with the URDF's inertias and without friction; joints beside the way from base
        to tip stand in the middle of their range. Raises InvalidArgument for other sizes or values that are not finite.
        """
    def jacobian(self, q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6, n) linear velocity (rows 0-2), then angular velocity of the tip (rows 3-5), in the base frame, by KDL.
        """
    def manipulability(self, q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> float:
        """
        sqrt(det(J J^T)), 0 where the arm is singular (Yoshikawa 1985).
        """
    def with_limits(self, *, lower: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, upper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, effort: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, acceleration: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, jerk: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, tool_speed: typing.SupportsFloat | typing.SupportsIndex | None = None, source: LimitSource | dict = ...) -> Arm:
        """
        A copy with other joint limits, each of n values; what is None stays.
        
        lower, upper in rad (m of a sliding joint); velocity, acceleration and jerk per s, s^2 and s^3; effort in N m (N);
        tool_speed, one number, in m/s. Infinity means that there is none. `source` says where they come from: one LimitSource, or a dict as
        `limit_sources` for each joint. Raises InvalidArgument unless lower < upper and all other limits are > 0.
        """
    def with_tool(self, frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Arm:
        """
        A copy whose tip is a frame fixed to this one's, for what a flange carries.
        
        `frame` (4, 4) is the tool in the tip, m. Its link is called like the tip with "_tool" behind and weighs nothing.
        Raises InvalidArgument unless it is a pose.
        """
    @property
    def acceleration_limit(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) rad/s^2 or m/s^2; 10 is assumed where nobody states one: a URDF 1.0 cannot.
        """
    @property
    def base(self) -> str:
        """
        Link in whose frame poses are given.
        """
    @property
    def choice(self) -> str:
        """
        "6 joints, j1 to j6; held still: jaw" where base and tip were chosen; empty where both were stated.
        """
    @property
    def effort_limit(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) N m or N; inf where nobody states one.
        """
    @property
    def folder(self) -> str:
        """
        Folder to which mesh paths are relative; empty if unknown.
        """
    @property
    def gravity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) m/s^2 in the base frame: 9.81 along -z of the URDF's root.
        """
    @property
    def jerk_limit(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) rad/s^3 or m/s^3; inf where nobody states one.
        """
    @property
    def joint_count(self) -> int:
        """
        Number of free joints, n.
        """
    @property
    def joint_names(self) -> list:
        """
        Names of the n free joints, from base to tip.
        """
    @property
    def limit_sources(self) -> dict:
        """
        Where the limits come from: a tuple of n LimitSource for each of position, velocity, acceleration, jerk and effort.
        """
    @property
    def lower(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) rad or m; -inf for a continuous joint.
        """
    @property
    def name(self) -> str:
        """
        Name of the robot.
        """
    @property
    def tip(self) -> str:
        """
        Link whose pose is given.
        """
    @property
    def tool_speed_limit(self) -> float:
        """
        m/s of the tip; inf where nobody states one.
        """
    @property
    def upper(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) rad or m; inf for a continuous joint.
        """
    @property
    def urdf(self) -> str:
        """
        The text that was read.
        """
    @property
    def velocity_limit(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) rad/s or m/s; inf where nobody states one.
        """
    @property
    def warnings(self) -> list:
        """
        Non-fatal problems of the URDF, one sentence each.
        """
class IkStatus(enum.Enum):
    """
    Why joints do or do not meet a pose.
    """
    budget: typing.ClassVar[IkStatus]
    invalid_input: typing.ClassVar[IkStatus]
    limit_blocked: typing.ClassVar[IkStatus]
    ok: typing.ClassVar[IkStatus]
    out_of_reach: typing.ClassVar[IkStatus]
    singular: typing.ClassVar[IkStatus]
    step_limited: typing.ClassVar[IkStatus]
    @classmethod
    def __new__(cls, value):
        ...
class IkResult:
    """
    The joints whose tip is at the pose, or as close to it as the search came.
    """
    def __getstate__(self) -> tuple[numpy.typing.NDArray[numpy.float64], IkStatus, float, float, int, float, list[int]]:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def angle_error(self) -> float:
        """
        rad, by KDL's forward kinematics.
        """
    @property
    def blocked(self) -> list[int]:
        """
        Indices of the joints that a limit holds back.
        """
    @property
    def iterations(self) -> int:
        ...
    @property
    def joints(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) rad or m.
        """
    @property
    def limit_margin(self) -> float:
        """
        rad or m from the nearest joint limit.
        """
    @property
    def ok(self) -> bool:
        """
        True if status is ok.
        """
    @property
    def position_error(self) -> float:
        """
        m, by KDL's forward kinematics.
        """
    @property
    def status(self) -> IkStatus:
        ...
class IkBatch:
    """
    What solve_many found for N poses.
    """
    def __getstate__(self) -> tuple[numpy.typing.NDArray[numpy.float64], list[IkStatus], numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], int]:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def angle_error(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,) rad.
        """
    @property
    def joints(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, n) rad or m.
        """
    @property
    def position_error(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,) m.
        """
    @property
    def solved(self) -> int:
        """
        How many poses have the status ok.
        """
    @property
    def status(self) -> list[IkStatus]:
        """
        N times IkStatus.
        """
class PathReport:
    """
    How well joints follow a path of T poses.
    """
    def __getstate__(self) -> tuple:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def summary(self) -> str:
        """
        The worst errors and the runs that were missed, in one sentence.
        """
    @property
    def angle_error(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) rad.
        """
    @property
    def complete(self) -> bool:
        """
        True if every pose is met.
        """
    @property
    def limit_margin(self) -> float:
        """
        rad or m, the smallest distance from a joint limit.
        """
    @property
    def max_step(self) -> float:
        """
        rad or m, the largest step of any joint.
        """
    @property
    def missed(self) -> list[tuple[int, int]]:
        """
        First and last index of each run of poses that were missed.
        """
    @property
    def position_error(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) m.
        """
    @property
    def solved(self) -> int:
        """
        How many poses have the status ok.
        """
    @property
    def starts_tried(self) -> int:
        """
        Joint paths that were tracked.
        """
    @property
    def status(self) -> list[IkStatus]:
        """
        T times IkStatus.
        """
    @property
    def velocity_ratio(self) -> float:
        """
        The largest speed over the velocity limit.
        """
class SplineEnds(enum.Enum):
    """
    How a cubic spline ends.
    """
    at_rest: typing.ClassVar[SplineEnds]
    not_a_knot: typing.ClassVar[SplineEnds]
    @classmethod
    def __new__(cls, value):
        ...
class JointTrajectory:
    """
    Joints over time, with the derivatives of their C2 cubic spline.
    """
    @staticmethod
    def through(times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], joint_names: collections.abc.Sequence[str] = [], ends: SplineEnds = ...) -> JointTrajectory:
        """
        The C2 cubic spline through positions (T, n) at times (T,) s, strictly increasing.
        """
    def __getstate__(self) -> tuple:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, n) rad/s^2.
        """
    @property
    def joint_names(self) -> list[str]:
        ...
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, n) rad.
        """
    @property
    def report(self) -> PathReport:
        ...
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s.
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T, n) rad/s.
        """
class IkBackend(enum.Enum):
    """
    Which KDL position solver makes the single descents.
    """
    bounded_lm: typing.ClassVar[IkBackend]
    kdl_lma: typing.ClassVar[IkBackend]
    kdl_nr_jl: typing.ClassVar[IkBackend]
    @classmethod
    def __new__(cls, value):
        ...
class IkOptions:
    """
    How InverseKinematics searches.
    """
    __hash__: typing.ClassVar[None] = None
    backend: IkBackend
    def __copy__(self) -> IkOptions:
        ...
    def __deepcopy__(self, memo: dict) -> IkOptions:
        ...
    def __eq__(self, arg0: typing.Any) -> bool:
        ...
    def __getstate__(self) -> dict:
        ...
    def __init__(self, **kwargs) -> None:
        """
        The fields as keywords.
        """
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def angle_tolerance(self) -> float:
        """
        rad, > 0.
        """
    @angle_tolerance.setter
    def angle_tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def angle_weight(self) -> float:
        """
        m per rad: closest is position + weight * angle.
        """
    @angle_weight.setter
    def angle_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def diagnose(self) -> bool:
        """
        Search on without limits to tell why a pose is missed.
        """
    @diagnose.setter
    def diagnose(self, arg0: bool) -> None:
        ...
    @property
    def iteration_limit(self) -> int:
        """
        Of one solve, all restarts together.
        """
    @iteration_limit.setter
    def iteration_limit(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def max_step(self) -> float:
        """
        rad or m: how far solve may leave the seed.
        """
    @max_step.setter
    def max_step(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def position_tolerance(self) -> float:
        """
        m, > 0.
        """
    @position_tolerance.setter
    def position_tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def random_seed(self) -> int:
        ...
    @random_seed.setter
    def random_seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def weight(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6,) how much of the pose counts, in its own axes: moving along x, y, z, turning about x, y, z; 0 is free.
        """
    @weight.setter
    def weight(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
class FollowOptions:
    """
    How InverseKinematics.follow goes about a path.
    """
    __hash__: typing.ClassVar[None] = None
    respect_velocity: bool
    def __copy__(self) -> FollowOptions:
        ...
    def __deepcopy__(self, memo: dict) -> FollowOptions:
        ...
    def __eq__(self, arg0: typing.Any) -> bool:
        ...
    def __getstate__(self) -> dict:
        ...
    def __init__(self, **kwargs) -> None:
        """
        The fields as keywords.
        """
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def anchors(self) -> int:
        """
        Poses of the path at which starts are searched.
        """
    @anchors.setter
    def anchors(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def angle_tolerance(self) -> float:
        """
        rad: when a pose counts as met.
        """
    @angle_tolerance.setter
    def angle_tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def max_step(self) -> float:
        """
        rad or m from one pose to the next.
        """
    @max_step.setter
    def max_step(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def position_tolerance(self) -> float:
        """
        m: when a pose counts as met.
        """
    @position_tolerance.setter
    def position_tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def start(self) -> typing.Any:
        """
        (n,) where the robot already stands, or None to search.
        """
    @start.setter
    def start(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None) -> None:
        ...
    @property
    def starts(self) -> int:
        """
        Joints tried at each anchor.
        """
    @starts.setter
    def starts(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def thorough(self) -> bool:
        """
        Search a roadmap where tracking misses a pose, and calm the null space.
        """
    @thorough.setter
    def thorough(self, arg0: bool) -> None:
        ...
class IkBranches:
    """
    The different joints that meet one pose, one after the other.
    """
    def __iter__(self) -> IkBranches:
        ...
    def __next__(self) -> IkResult:
        ...
class InverseKinematics:
    """
    Joints for poses of an Arm's tip.
    
    The fields of IkOptions are taken as keywords too. Every answer depends on the arguments and the options alone.
    """
    def __init__(self, arm: Arm, options: IkOptions | None = None, **kwargs) -> None:
        ...
    def branches(self, pose: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], seed: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, *, apart: typing.SupportsFloat | typing.SupportsIndex = 0.3, tries: typing.SupportsInt | typing.SupportsIndex = 200) -> IkBranches:
        """
        Iterate over the different joints that meet the pose (4, 4), each an IkResult; the seed's first.
        
        Some joint of each differs from every one before by `apart` [rad or m]; the iteration ends when `tries` descents
        from random joints found no more. Give the one you choose to follow(start=...).
        """
    def follow(self, path: typing.Any, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, options: FollowOptions | None = None, strict: bool = False, **kwargs) -> JointTrajectory:
        """
        Joints for a whole path, with a report for every pose. Releases the GIL.
        
        `path` is a trajectory with .time (T,) and .pose (T, 4, 4), or the poses themselves with times=(T,) in s.
        The fields of FollowOptions are taken as keywords too. strict: raise errors.IkError, with the report, unless
        every pose is met.
        """
    def solve(self, pose: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], seed: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, strict: bool = False) -> IkResult:
        """
        Joints (n,) whose tip is at the pose (4, 4), or as close as can be, with a status that says why.
        
        Never raises because a pose is out of reach, unless strict: then errors.IkError with this result as its
        `report`. Raises InvalidArgument for a pose that is none.
        """
    def solve_many(self, poses: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], seed: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None) -> IkBatch:
        """
        solve() for each of the poses (N, 4, 4), each begun at the last joints that met theirs. Releases the GIL.
        """
    @property
    def arm(self) -> Arm:
        ...
    @property
    def middle(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) the middle of each joint's range: the seed where none is given.
        """
    @property
    def options(self) -> IkOptions:
        ...
class TrackOptions:
    """
    How a JointTracker follows.
    """
    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> TrackOptions:
        ...
    def __deepcopy__(self, memo: dict) -> TrackOptions:
        ...
    def __eq__(self, arg0: typing.Any) -> bool:
        ...
    def __getstate__(self) -> dict:
        ...
    def __init__(self, **kwargs) -> None:
        """
        The fields as keywords.
        """
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def angle_tolerance(self) -> float:
        """
        rad, > 0: when a pose counts as met.
        """
    @angle_tolerance.setter
    def angle_tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def angle_weight(self) -> float:
        """
        m per rad: closest weighs the angle so against the position.
        """
    @angle_weight.setter
    def angle_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def limit_pull(self) -> float:
        """
        rad per m that the tip moves: how much joints to spare are drawn away from their limits.
        """
    @limit_pull.setter
    def limit_pull(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def position_tolerance(self) -> float:
        """
        m, > 0: when a pose counts as met.
        """
    @position_tolerance.setter
    def position_tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def weight(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6,) how much of the pose counts, in its own axes; 0 is free. See IkOptions.weight.
        """
    @weight.setter
    def weight(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
class JointTracker:
    """
    The differential inverse kinematics of a control loop: joints that go along with a pose that moves.
    
    Each track() begins at the joints of the one before and moves every joint by at most velocity limit x dt, within the
    joint limits, as close to the pose as that allows. A joint that stands up to 1e-3 rad or m beyond a limit, as encoders
    read it, comes back onto it within its velocity limit. The fields of TrackOptions are taken as keywords too.
    """
    def __copy__(self) -> JointTracker:
        ...
    def __deepcopy__(self, memo: dict) -> JointTracker:
        ...
    def __init__(self, arm: Arm, start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], options: TrackOptions | None = None, **kwargs) -> None:
        ...
    def track(self, pose: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], dt: typing.SupportsFloat | typing.SupportsIndex) -> IkStatus:
        """
        One step of dt seconds (> 0) towards the pose (4, 4).
        
        Returns IkStatus.ok, or why the pose is missed. Raises InvalidArgument, and changes nothing, for a pose or time that
        is none.
        """
    @property
    def angle_error(self) -> float:
        """
        rad, of the last step, by KDL.
        """
    @property
    def arm(self) -> Arm:
        ...
    @property
    def joints(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) rad or m, within the limits or on the way back onto them; set it to where the robot stands after all, and its velocity becomes 0.
        """
    @joints.setter
    def joints(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    @property
    def limit_excess(self) -> float:
        """
        rad or m: how far the joints that were given last lay beyond a limit; 0 within.
        """
    @property
    def options(self) -> TrackOptions:
        ...
    @property
    def position_error(self) -> float:
        """
        m, of the last step, by KDL.
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,) rad/s or m/s, of the last step.
        """
class PacedLimit(enum.Enum):
    """
    What a motion is slowed down for.
    """
    acceleration: typing.ClassVar[PacedLimit]
    effort: typing.ClassVar[PacedLimit]
    jerk: typing.ClassVar[PacedLimit]
    tool_speed: typing.ClassVar[PacedLimit]
    velocity: typing.ClassVar[PacedLimit]
    @classmethod
    def __new__(cls, value):
        ...
class Demand:
    """
    What a motion asks of its limits where it asks most.
    """
    @property
    def factor(self) -> float:
        """
        On the duration; below 1 the motion may be that much faster.
        """
    @property
    def joint(self) -> int:
        """
        -1 for the tool's speed, or if nothing moves.
        """
    @property
    def limit(self) -> PacedLimit:
        ...
    @property
    def time(self) -> float:
        """
        s, of the sample.
        """
class Pace:
    """
    A clock: when a motion that was recorded at one time is carried out.
    """
    def __getstate__(self) -> tuple:
        ...
    def __init__(self, time: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], slowdown: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rate: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def rate(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) 1/s, d ln slowdown / d original time.
        """
    @property
    def slowdown(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) d time / d original time, >= 1.
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (T,) s, of each sample, carried out.
        """
class Paced:
    """
    Joints at their original tempo wherever that is within the limits.
    """
    @property
    def joints(self) -> JointTrajectory:
        ...
    @property
    def pace(self) -> Pace:
        ...
class PathFit:
    """
    What `fit_path` found.
    """
    @property
    def angle_max(self) -> float:
        """
        rad
        """
    @property
    def angle_rms(self) -> float:
        """
        rad
        """
    @property
    def base_change(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4): the path as placed is base_change @ pose @ tool_change.
        """
    @property
    def duration_factor(self) -> float:
        """
        That the limits ask for.
        """
    @property
    def improved(self) -> bool:
        """
        False where the joints are those of the start.
        """
    @property
    def iterations(self) -> int:
        """
        Steps that were spent.
        """
    @property
    def joints(self) -> JointTrajectory:
        """
        At the times of the path.
        """
    @property
    def limit_margin(self) -> float:
        """
        rad or m, the smallest distance from a limit.
        """
    @property
    def position_max(self) -> float:
        """
        m from the path, between its samples too.
        """
    @property
    def position_rms(self) -> float:
        """
        m
        """
    @property
    def start_factor(self) -> float:
        """
        The same of the start.
        """
    @property
    def tool_change(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4)
        """
def align(a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], *, angle_weight: typing.SupportsFloat | typing.SupportsIndex = 0.2, band: typing.SupportsFloat | typing.SupportsIndex | None = None) -> Alignment:
    """
    Dynamic time warping (Sakoe and Chiba 1978, steps of weight 1 each) of rows (T, d) and (S, d) by their Euclidean distance, or of poses (T, 4, 4) and (S, 4, 4) by |pa - pb| + angle_weight * angle(Ra, Rb) [m; angle_weight in m/rad]. `band`: how many samples of b a pair may lie off the straight line from the first pair to the last, widened where no path would fit. Raises InvalidArgument, naming the sample, for numbers that are not finite, no samples, matrices that are no rotations, different columns.
    """
@typing.overload
def assess(model: Dmp, demonstrations: collections.abc.Sequence[Demonstration], position: typing.SupportsFloat | typing.SupportsIndex = 0.001, angle: typing.SupportsFloat | typing.SupportsIndex = 0.0087) -> FitReport:
    """
    How a model reproduces a list of demonstrations, and what was found in them. `position` and `angle` (rad) are the RMSE that the suggested number of kernels shall reach.
    """
@typing.overload
def assess(model: OrientationDmp, demonstrations: collections.abc.Sequence[OrientationDemonstration], position: typing.SupportsFloat | typing.SupportsIndex = 0.001, angle: typing.SupportsFloat | typing.SupportsIndex = 0.0087) -> FitReport:
    """
    How a model reproduces a list of demonstrations, and what was found in them. `position` and `angle` (rad) are the RMSE that the suggested number of kernels shall reach.
    """
@typing.overload
def assess(model: PoseDmp, demonstrations: collections.abc.Sequence[PoseDemonstration], position: typing.SupportsFloat | typing.SupportsIndex = 0.001, angle: typing.SupportsFloat | typing.SupportsIndex = 0.0087) -> FitReport:
    """
    How a model reproduces a list of demonstrations, and what was found in them. `position` and `angle` (rad) are the RMSE that the suggested number of kernels shall reach.
    """
@typing.overload
def assess(model: PoseGripperDmp, demonstrations: collections.abc.Sequence[PoseGripperDemonstration], position: typing.SupportsFloat | typing.SupportsIndex = 0.001, angle: typing.SupportsFloat | typing.SupportsIndex = 0.0087) -> FitReport:
    """
    How a model reproduces a list of demonstrations, and what was found in them. `position` and `angle` (rad) are the RMSE that the suggested number of kernels shall reach.
    """
@typing.overload
def average(models: collections.abc.Sequence[Dmp]) -> Dmp:
    """
    The model with the mean of all weights, starts, goals, start velocities and durations. Raises InvalidArgument for models that differ in options or dimension; a joint fit is right everywhere.
    """
@typing.overload
def average(models: collections.abc.Sequence[OrientationDmp]) -> OrientationDmp:
    """
    The model with the mean of all weights, starts, goals, start velocities and durations. Raises InvalidArgument for models that differ in options or dimension; a joint fit is right everywhere.
    """
@typing.overload
def average(models: collections.abc.Sequence[PoseDmp]) -> PoseDmp:
    """
    The model with the mean of all weights, starts, goals, start velocities and durations. Raises InvalidArgument for models that differ in options or dimension; a joint fit is right everywhere.
    """
@typing.overload
def average(models: collections.abc.Sequence[PoseGripperDmp]) -> PoseGripperDmp:
    """
    The model with the mean of all weights, starts, goals, start velocities and durations. Raises InvalidArgument for models that differ in options or dimension; a joint fit is right everywhere.
    """
@typing.overload
def blend(distributions: collections.abc.Sequence[DmpDistribution], weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> DmpDistribution:
    """
    The product of distributions to these powers (positive, one for each): what they agree on.
    """
@typing.overload
def blend(distributions: collections.abc.Sequence[OrientationDistribution], weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> OrientationDistribution:
    """
    The product of distributions to these powers (positive, one for each): what they agree on.
    """
@typing.overload
def blend(distributions: collections.abc.Sequence[PoseDistribution], weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> PoseDistribution:
    """
    The product of distributions to these powers (positive, one for each): what they agree on.
    """
@typing.overload
def blend(distributions: collections.abc.Sequence[PoseGripperDistribution], weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> PoseGripperDistribution:
    """
    The product of distributions to these powers (positive, one for each): what they agree on.
    """
def damping_of(stiffness: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], zeta: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> numpy.typing.NDArray[numpy.float64]:
    """
    2 zeta sqrt(K) of a symmetric positive definite stiffness (d, d), for unit masses.
    """
def duration_factor(joints: JointTrajectory, velocity_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], acceleration_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], effort_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, *, arm: Arm | None = None, gravity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = [0.0, 0.0, -9.81]) -> float:
    """
    The smallest factor on the duration with which the joints' spline stays within the limits.
    
    Velocity [rad/s] and acceleration limits [rad/s^2], (n,) each, are looked at between the samples too; effort limits (n,)
    [N m], for which the arm is needed, at the samples, by KDL's inverse dynamics with `gravity` (3,) [m/s^2] in the base
    frame. 0 if nothing moves. Raises InvalidArgument for limits of other sizes or signs, or an effort with which the arm
    cannot stand still.
    """
def fastest_tip(arm: Arm) -> tuple[float, float]:
    """
    (m/s, rad/s) that the arm's tip can move and turn at most, in any posture within the joint limits.
    
    Every joint within its velocity limit; infinity where one has none. Exact over the joint velocities, and over postures
    what a search of 20 000 random ones found: no motion that is followed exactly can be faster.
    """
@typing.overload
def find_cycle(recording: Demonstration, minimum_period: typing.SupportsFloat | typing.SupportsIndex = 0.0, harmonics: typing.SupportsInt | typing.SupportsIndex = 8) -> Cycle:
    """
    Finds the period of a recording that repeats, the parts at its ends that do not, and the one cycle that all of them are, each at its own tempo. `minimum_period` (s): half the true period may pass for it where a motion is the same on its way there and back. `harmonics` of the cycle, 1 to 40. Raises InvalidArgument for a recording without a period or of fewer than two cycles.
    """
@typing.overload
def find_cycle(recording: OrientationDemonstration, minimum_period: typing.SupportsFloat | typing.SupportsIndex = 0.0, harmonics: typing.SupportsInt | typing.SupportsIndex = 8) -> OrientationCycle:
    """
    Finds the period of a recording that repeats, the parts at its ends that do not, and the one cycle that all of them are, each at its own tempo. `minimum_period` (s): half the true period may pass for it where a motion is the same on its way there and back. `harmonics` of the cycle, 1 to 40. Raises InvalidArgument for a recording without a period or of fewer than two cycles.
    """
@typing.overload
def find_cycle(recording: PoseDemonstration, minimum_period: typing.SupportsFloat | typing.SupportsIndex = 0.0, harmonics: typing.SupportsInt | typing.SupportsIndex = 8) -> PoseCycle:
    """
    Finds the period of a recording that repeats, the parts at its ends that do not, and the one cycle that all of them are, each at its own tempo. `minimum_period` (s): half the true period may pass for it where a motion is the same on its way there and back. `harmonics` of the cycle, 1 to 40. Raises InvalidArgument for a recording without a period or of fewer than two cycles.
    """
def fit_forcing(basis: GaussianBasis, targets: collections.abc.Sequence[ForcingTarget], options: DmpOptions | None = None, **kwargs) -> numpy.typing.NDArray[numpy.float64]:
    """
    The weights (N, dims) of one forcing term for all targets together, by the options' regression.
    """
def fit_path(arm: Arm, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], poses: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], *, position_tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.001, angle_tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.008727, weight: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, velocity_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, acceleration_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, effort_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, slowdown: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, slowdown_rate: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, free_placement: bool = False, floor: typing.SupportsFloat | typing.SupportsIndex = ..., target: typing.SupportsFloat | typing.SupportsIndex = 1.0, iterations: typing.SupportsInt | typing.SupportsIndex = 450, spline_coefficients: typing.SupportsInt | typing.SupportsIndex = 0, accept: typing.Any = None) -> PathFit:
    """
    Joints that follow a path faster, each pose within a tolerance.
    
    `times` (T,) s, `poses` (T, 4, 4) of the tip in the base frame, `start` (T, n) joints that follow them. The deviation of
    any sample, and between them, is at most `position_tolerance` [m] and `angle_tolerance` [rad] in the directions whose
    `weight` (6,) is above 0 (as in IkOptions). Velocity and acceleration limits, (n,) each, are the arm's unless given;
    effort limits (n,) [N m] are looked at where given, by Arm.inverse_dynamics. With `free_placement` the path may also be
    moved (not below `floor` [m]), turned about z of the base, and the tool turned. The search ends at a duration factor of
    `target` or after `iterations` steps; `slowdown` and `slowdown_rate` (T,) are a Pace on which the limits are held.
    `accept`, called with a JointTrajectory, has a last word. Never slower than the start, the same arguments give the same
    joints. Raises InvalidArgument for arguments of other sizes or out of range.
    """
def frechet(a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> float:
    """
    Discrete Frechet distance of paths (T, d) and (S, d), in their unit: the shortest leash that lets a walker on each reach the end, both going forward only, from sample to sample (Eiter and Mannila 1994).
    """
def from_json(text: str) -> typing.Any:
    """
    The model in the text of a model file. Raises InvalidArgument naming the place.
    """
def largest_demand(joints: JointTrajectory, velocity_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], acceleration_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], effort_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, *, jerk_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, tool_speed_limit: typing.SupportsFloat | typing.SupportsIndex = ..., arm: Arm | None = None) -> Demand:
    """
    The joint, limit and time that ask for the longest duration; limits as in `paced`.
    """
def load(path: os.PathLike | str | bytes) -> typing.Any:
    """
    The model in a file (a Dmp, OrientationDmp, PoseDmp or PoseGripperDmp), bit for bit as it was saved. Raises FileError, or InvalidArgument naming the place.
    """
def paced(joints: JointTrajectory, velocity_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], acceleration_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], effort_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, *, jerk_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, tool_speed_limit: typing.SupportsFloat | typing.SupportsIndex = ..., tempo_rate: typing.SupportsFloat | typing.SupportsIndex = 3.4657359027997265, arm: Arm | None = None) -> Paced:
    """
    The same joints, slower only where limits ask for it: elsewhere the original time is kept.
    
    Velocity [rad/s], acceleration [rad/s^2] and jerk limits [rad/s^3], (n,) each, hold on the C2 spline that is returned;
    effort limits (n,) [N m] at its samples and the tool's speed [m/s] between them, for both of which the arm is needed.
    The logarithm of the slowdown changes by at most `tempo_rate` [1/s] in a second of the original time; the default is a
    factor of 2 in 0.2 s. Never faster than the original, never longer than `stretched` by what the worst sample asks for.
    Raises InvalidArgument for limits of other sizes or signs, or an effort with which the arm cannot stand still.
    """
def retimed(motion: PoseTrajectory, pace: Pace) -> PoseTrajectory:
    """
    The same poses on another clock, with the velocities and accelerations that they have on it.
    """
@typing.overload
def save(model: Dmp, path: os.PathLike | str | bytes) -> None:
    """
    Writes a model file (JSON), whole or not at all. Raises FileError.
    """
@typing.overload
def save(model: DmpSequence, path: os.PathLike | str | bytes) -> None:
    ...
@typing.overload
def save(model: DmpDistribution, path: os.PathLike | str | bytes) -> None:
    ...
@typing.overload
def save(model: OrientationDmp, path: os.PathLike | str | bytes) -> None:
    """
    Writes a model file (JSON), whole or not at all. Raises FileError.
    """
@typing.overload
def save(model: OrientationDmpSequence, path: os.PathLike | str | bytes) -> None:
    ...
@typing.overload
def save(model: OrientationDistribution, path: os.PathLike | str | bytes) -> None:
    ...
@typing.overload
def save(model: PoseDmp, path: os.PathLike | str | bytes) -> None:
    """
    Writes a model file (JSON), whole or not at all. Raises FileError.
    """
@typing.overload
def save(model: PoseDmpSequence, path: os.PathLike | str | bytes) -> None:
    ...
@typing.overload
def save(model: PoseDistribution, path: os.PathLike | str | bytes) -> None:
    ...
@typing.overload
def save(model: PoseGripperDmp, path: os.PathLike | str | bytes) -> None:
    """
    Writes a model file (JSON), whole or not at all. Raises FileError.
    """
@typing.overload
def save(model: PoseGripperDmpSequence, path: os.PathLike | str | bytes) -> None:
    ...
@typing.overload
def save(model: PoseGripperDistribution, path: os.PathLike | str | bytes) -> None:
    ...
@typing.overload
def spread(demonstrations: collections.abc.Sequence[Demonstration], count: typing.SupportsInt | typing.SupportsIndex = 101) -> Spread:
    """
    Mean and covariance of demonstrations at `count` even phases. Raises InvalidArgument for none, or for different dimensions.
    """
@typing.overload
def spread(demonstrations: collections.abc.Sequence[PoseDemonstration], count: typing.SupportsInt | typing.SupportsIndex = 101) -> PoseSpread:
    """
    Mean and covariance of demonstrations at `count` even phases. Raises InvalidArgument for none, or for different dimensions.
    """
def stretched(joints: JointTrajectory, factor: typing.SupportsFloat | typing.SupportsIndex) -> JointTrajectory:
    """
    The same path, `factor` times as long from the same first time.
    """
def time_optimal(joints: JointTrajectory, velocity_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], acceleration_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], effort_limit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, *, arm: Arm | None = None, gravity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = [0.0, 0.0, -9.81]) -> JointTrajectory:
    """
    The same joints at other times: from rest to rest, close to as fast as the limits allow.
    
    Velocity [rad/s] and acceleration limits [rad/s^2], (n,) each, hold everywhere on the C2 spline that is returned;
    effort limits (n,) [N m], for which the arm is needed, at its samples, by KDL's inverse dynamics with `gravity` (3,)
    [m/s^2] in the base frame. Reachability analysis (TOPP-RA: Pham and Pham, IEEE Trans. Robotics 34(3), 2018). Raises
    InvalidArgument for limits of other sizes or signs, or an effort with which the arm cannot stand still.
    """
def tip_motion(arm: Arm, joints: JointTrajectory) -> PoseTrajectory:
    """
    How the arm's tip moves with its joints, as a PoseTrajectory in the base frame, by KDL.
    """
@typing.overload
def to_json(model: Dmp) -> str:
    """
    The text of a model file.
    """
@typing.overload
def to_json(model: DmpSequence) -> str:
    ...
@typing.overload
def to_json(model: DmpDistribution) -> str:
    ...
@typing.overload
def to_json(model: OrientationDmp) -> str:
    """
    The text of a model file.
    """
@typing.overload
def to_json(model: OrientationDmpSequence) -> str:
    ...
@typing.overload
def to_json(model: OrientationDistribution) -> str:
    ...
@typing.overload
def to_json(model: PoseDmp) -> str:
    """
    The text of a model file.
    """
@typing.overload
def to_json(model: PoseDmpSequence) -> str:
    ...
@typing.overload
def to_json(model: PoseDistribution) -> str:
    ...
@typing.overload
def to_json(model: PoseGripperDmp) -> str:
    """
    The text of a model file.
    """
@typing.overload
def to_json(model: PoseGripperDmpSequence) -> str:
    ...
@typing.overload
def to_json(model: PoseGripperDistribution) -> str:
    ...
__version__: str = '0.2.0'
