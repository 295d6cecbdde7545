# Written by tests/python/write_stubs.py from the flags of the commands.
import os
from typing import Any, Literal, Mapping, Optional, Sequence, Union

from armcal import plot
from armcal._armcal import INERTIAL_NAMES, INERTIAL_UNITS, InputError, PredictedLog, Robot, UsageError, __version__, options, read_robot
from armcal.commands import Logs, Path, Progress, Range, RobotLike
from armcal.log import Log, read_log
from armcal.robot import from_arrays as _from_arrays
from armcal.results import Calibration, Comparison, Diagnosis, Estimates, Excitation, Inspection, Merger, Reduction, Result, Simulation, Verification
__all__ = ['Calibration', 'Comparison', 'Diagnosis', 'Estimates', 'Excitation', 'INERTIAL_NAMES', 'INERTIAL_UNITS', 'InputError', 'Inspection', 'Log', 'Merger', 'PredictedLog', 'Reduction', 'Result', 'Robot', 'Simulation', 'UsageError', 'Verification', '__version__', 'calibrate', 'compare', 'diagnose', 'excite', 'inspect', 'merge', 'options', 'plot', 'read_log', 'read_robot', 'reduce', 'simulate', 'verify']

def calibrate(
    robot: RobotLike,
    log: Optional[Logs] = None,
    *,
    validate: Optional[Logs] = None,
    progress: Progress = None,
    bandwidth: Optional[float] = None,
    geometry: Literal['all_lengths', 'known', 'lengths', 'offsets', 'refine'] = 'known',
    estimate: Literal['auto', 'linear', 'refined'] = 'auto',
    trust: float = 0.5,
    poses: Optional[Path] = None,
    crop: Optional[Range] = None,
    validate_crop: Optional[Range] = None,
    select: bool = False,
    segment: float = 5.0,
    torque_kind: Literal['auto', 'command', 'current', 'link', 'motor', 'voltage'] = 'auto',
    torque_constants: Optional[Union[float, Sequence[float]]] = None,
    torque_constants_stddev: Optional[float] = None,
    gear_ratios: Optional[Union[float, Sequence[float]]] = None,
    topics: Optional[Union[str, Sequence[str]]] = None,
    controller: Optional[Path] = None,
    gains_trust: float = 0.0,
    delay_trust: float = 0.02,
    torque_log: Optional[Logs] = None,
    identification: Literal['differential', 'integral', 'weak'] = 'weak',
    solver: Literal['batch', 'recursive', 'weighted'] = 'weighted',
    loss: Literal['auto', 'cauchy', 'huber', 'squared', 'tukey'] = 'auto',
    trajectory: Literal['corrected', 'measured'] = 'measured',
    joint_terms: Union[str, Sequence[str]] = 'viscous,coulomb,offset,armature',
    coulomb_width: str = 'auto',
    window: Optional[float] = None,
    interval: float = 0.5,
    intervals: Optional[Union[Range, Sequence[Range]]] = None,
    quadrature: Literal['simpson', 'trapezoid'] = 'trapezoid',
    length_trust: float = 0.01,
    angle_trust: float = 0.02,
    payload_mass: Optional[float] = None,
    payload_log: Optional[Logs] = None,
    camera: Optional[Logs] = None,
    camera_on: Literal['tool', 'world'] = 'tool',
    export: Optional[Union[str, Sequence[str]]] = None,
    base: Optional[str] = None,
    tip: Optional[str] = None,
    posture: Optional[Mapping[str, float]] = None,
    gravity: Optional[Union[float, Sequence[float]]] = None,
    robot_folder: Optional[Path] = None,
    out: Optional[Path] = None,
    flagfile: Optional[Path] = None,
    threads: int = 0,
) -> Calibration:
    """Dynamics and geometry of an arm from logs of its joint positions and
    torques, and from measured poses.

    robot     a Robot or its file
    log       logs to calibrate on, paths or Logs; None: from poses alone
    validate  logs held out to check the result
    progress  is called with what is being done and its share, 0 to 1; below 0
              nobody knows

    Options:
    bandwidth            float, Hz: cutoff of the low pass; 0: data as they
                         are; default: 10 times the motion's frequency, 8 to 20
                         Hz (watch: 20)
    geometry             str: known; lengths (between the joint axes: those the
                         robot file declares unknown, or all that are not zero,
                         are estimated), all_lengths; offsets (joint zeros are
                         refined), refine (all of the file's geometry is)
                         (default known)
    estimate             str: refined (model parameters and a physically
                         consistent robot for simulators), linear (model
                         parameters only), auto (refined where the file has
                         masses) (default auto)
    trust                float: relative standard deviation of the file's
                         inertias (diagnose: 0.05 without --reference) (default
                         0.5)
    poses                Path: CSV of measured poses, wire lengths, touches,
                         images
    crop                 Range: of --log to use, s since its first row;
                         default: all (standstill is left out by itself)
    validate_crop        Range: of the logs held out to use; default: all
    select               bool: calibrate on the segments of the logs that tell
                         most, as few as tell nearly all
    segment              float, s: length of segments for --select (default 5)
    torque_kind          str: what the log's torque is: auto, link, motor
                         (motor side, times gear ratio), current, command,
                         voltage (default auto)
    torque_constants     Union[float, Sequence[float]]: per joint, N m/A:
                         torque = constant x gear ratio x current; N m/V of
                         voltages
    torque_constants_stddev float: of each joint's torque by which its scale
                         may be off, a standard deviation; default: .05 for
                         currents, .1 for voltages, .02 for torques, 0 for logs
                         of armcal simulate
    gear_ratios          Union[float, Sequence[float]]: per joint; default: 1
    topics               Union[str, Sequence[str]]: topics of ROS 2 bags, as in
                         /joint_states,effort:/torques,wrench:/ft
    controller           Path: YAML with the controller's law (pd, p, cascade),
                         rate, gains, limits, delay, lag; default: pd of 8 Hz
                         per joint, slower where that rings
    gains_trust          float: with --controller: relative standard deviation
                         of its gains, which are then estimated; 0: exact
                         (default 0)
    delay_trust          float, s: with --controller: standard deviation of the
                         command's delay, which is then estimated; 0: exact
                         (default 0.02)
    torque_log           Logs: logs with torques of the same arm, beside
                         --log's of commands: one estimate is made of both
    identification       str: weak (test functions, no acceleration),
                         differential (2.19), integral (2.27) (default weak)
    solver               str: weighted (noise of every joint re-estimated),
                         batch (2.25), recursive (2.28) (default weighted)
    loss                 str: what large residuals count: auto (huber for
                         torques, tukey for poses), huber, cauchy, tukey,
                         squared (all alike, and no gross error is taken out of
                         the torque) (default auto)
    trajectory           str: measured (recorded positions as they are, in weak
                         rows), corrected (maximum likelihood: splines through
                         all motions, fitted to positions and torques; for
                         noisy encoders) (default measured)
    joint_terms          Union[str, Sequence[str]]: what joints add to the
                         rigid arm, or none (default
                         viscous,coulomb,offset,armature)
    coulomb_width        str: how Coulomb friction changes sign: auto (fitted
                         per joint), a speed such as 0.02rad/s, or a
                         displacement such as 0.001rad, for all joints (default
                         auto)
    window               float, s: length of the weak form's test functions, s;
                         default: .87 periods of the bandwidth, to 0.3 for
                         noise
    interval             float, s: integral model: length of intervals (default
                         0.5)
    intervals            Union[Range, Sequence[Range]]: integral model: from T1
                         to T2, s; default: side by side
    quadrature           str: integral model: trapezoid, simpson (default
                         trapezoid)
    length_trust         float, m: standard deviation of the robot file's
                         lengths where they are refined, m (default 0.01)
    angle_trust          float, rad: standard deviation of the robot file's
                         angles where they are refined, and of the base's tilt,
                         rad (default 0.02)
    payload_mass         float, kg: of the payload in --payload_log: the torque
                         constants are estimated from the currents of --log
                         (bare arm) and --payload_log
    payload_log          Logs: logs of the same arm with a payload of
                         --payload_mass fixed to its last link
    camera               Logs: of --poses with images: camera_info YAML of ROS;
                         or estimate
    camera_on            str: where the camera is: tool (the board stands),
                         world (the board is on the tool) (default tool)
    export               Union[str, Sequence[str]]: formats to write the robot
                         in
    base                 str: (body) that the arm starts at; default: the root
    tip                  str: that the arm ends at, or links, as in
                         left_hand,right_hand; default: the only one
    posture              Mapping[str, float]: where other joints are held, such
                         as a gripper's, rad or m; default: next to 0
    gravity              Union[float, Sequence[float]]: gravity in the base
                         frame, m/s^2; default: the robot file's, for URDF
                         0,0,-9.81
    robot_folder         Path: that files which the robot's MJCF names may lie
                         in; default: its own folder
    out                  Path: for the result files; default: none (simulate:
                         needed)
    flagfile             Path: more flags, one --flag=value a line
    threads              int: that share the work; default: one per core.
                         Results are the same for any number (default 0)
    """

def verify(
    robot: RobotLike,
    log: Optional[Logs] = None,
    *,
    calibration: Union[Calibration, str, 'os.PathLike[str]', None] = None,
    progress: Progress = None,
    crop: Optional[Range] = None,
    bandwidth: Optional[float] = None,
    controller: Optional[Path] = None,
    budget: float = 60.0,
    seed: int = 0,
    torque_kind: Literal['auto', 'command', 'current', 'link', 'motor', 'voltage'] = 'auto',
    torque_constants: Optional[Union[float, Sequence[float]]] = None,
    torque_constants_stddev: Optional[float] = None,
    gear_ratios: Optional[Union[float, Sequence[float]]] = None,
    topics: Optional[Union[str, Sequence[str]]] = None,
    base: Optional[str] = None,
    tip: Optional[str] = None,
    posture: Optional[Mapping[str, float]] = None,
    gravity: Optional[Union[float, Sequence[float]]] = None,
    robot_folder: Optional[Path] = None,
    out: Optional[Path] = None,
    flagfile: Optional[Path] = None,
    threads: int = 0,
) -> Verification:
    """A robot, or a calibration of it, against an independent engine.

    calibration  a Calibration, its calibration.json or the folder of that;
                 robot is then the one that it was made of

    Options:
    crop                 Range: of --log to use, s since its first row;
                         default: all (standstill is left out by itself)
    bandwidth            float, Hz: cutoff of the low pass; 0: data as they
                         are; default: 10 times the motion's frequency, 8 to 20
                         Hz (watch: 20)
    controller           Path: YAML with the controller's law (pd, p, cascade),
                         rate, gains, limits, delay, lag; default: pd of 8 Hz
                         per joint, slower where that rings
    budget               float, s: for Simbody's simulations of stretches of
                         the log, the rest is armcal's; 0: all of them (default
                         60)
    seed                 int: of everything that is drawn at random (default 0)
    torque_kind          str: what the log's torque is: auto, link, motor
                         (motor side, times gear ratio), current, command,
                         voltage (default auto)
    torque_constants     Union[float, Sequence[float]]: per joint, N m/A:
                         torque = constant x gear ratio x current; N m/V of
                         voltages
    torque_constants_stddev float: of each joint's torque by which its scale
                         may be off, a standard deviation; default: .05 for
                         currents, .1 for voltages, .02 for torques, 0 for logs
                         of armcal simulate
    gear_ratios          Union[float, Sequence[float]]: per joint; default: 1
    topics               Union[str, Sequence[str]]: topics of ROS 2 bags, as in
                         /joint_states,effort:/torques,wrench:/ft
    base                 str: (body) that the arm starts at; default: the root
    tip                  str: that the arm ends at, or links, as in
                         left_hand,right_hand; default: the only one
    posture              Mapping[str, float]: where other joints are held, such
                         as a gripper's, rad or m; default: next to 0
    gravity              Union[float, Sequence[float]]: gravity in the base
                         frame, m/s^2; default: the robot file's, for URDF
                         0,0,-9.81
    robot_folder         Path: that files which the robot's MJCF names may lie
                         in; default: its own folder
    out                  Path: for the result files; default: none (simulate:
                         needed)
    flagfile             Path: more flags, one --flag=value a line
    threads              int: that share the work; default: one per core.
                         Results are the same for any number (default 0)
    """

def diagnose(
    robot: RobotLike,
    log: Logs,
    *,
    validate: Optional[Logs] = None,
    reference: Optional[Logs] = None,
    calibration: Union[Calibration, str, 'os.PathLike[str]', None] = None,
    progress: Progress = None,
    bandwidth: Optional[float] = None,
    poses: Optional[Path] = None,
    trust: float = 0.5,
    without: Optional[Union[str, Sequence[str]]] = None,
    forward: bool = True,
    verbose: bool = False,
    controller: Optional[Path] = None,
    seed: int = 0,
    crop: Optional[Range] = None,
    validate_crop: Optional[Range] = None,
    changes: bool = False,
    compliance: Optional[Path] = None,
    camera: Optional[Logs] = None,
    camera_on: Literal['tool', 'world'] = 'tool',
    length_trust: float = 0.01,
    angle_trust: float = 0.02,
    torque_kind: Literal['auto', 'command', 'current', 'link', 'motor', 'voltage'] = 'auto',
    torque_constants: Optional[Union[float, Sequence[float]]] = None,
    torque_constants_stddev: Optional[float] = None,
    gear_ratios: Optional[Union[float, Sequence[float]]] = None,
    topics: Optional[Union[str, Sequence[str]]] = None,
    export: Optional[Union[str, Sequence[str]]] = None,
    modules: Optional[Union[str, Sequence[str]]] = None,
    base: Optional[str] = None,
    tip: Optional[str] = None,
    posture: Optional[Mapping[str, float]] = None,
    gravity: Optional[Union[float, Sequence[float]]] = None,
    robot_folder: Optional[Path] = None,
    out: Optional[Path] = None,
    flagfile: Optional[Path] = None,
    threads: int = 0,
) -> Diagnosis:
    """Where the sim-to-real gap lies, which effect causes it, and how far it
    shrinks once that effect is in the model.

    log          logs of the real machine, paths or Logs
    validate     logs held out that the figures are of
    reference    logs of the same robot from before
    calibration  a Calibration, its calibration.json or the folder of that:
                 what is still missing in the calibrated robot; robot is then
                 the one that it was made of

    Options:
    bandwidth            float, Hz: cutoff of the low pass; 0: data as they
                         are; default: 10 times the motion's frequency, 8 to 20
                         Hz (watch: 20)
    poses                Path: CSV of measured poses, wire lengths, touches,
                         images
    trust                float: relative standard deviation of the file's
                         inertias (diagnose: 0.05 without --reference) (default
                         0.5)
    without              Union[str, Sequence[str]]: effects that are not
                         considered
    forward              bool: simulate the held-out logs as well: along their
                         commands with --controller, else over windows of 0.5 s
                         (default true)
    verbose              bool: list every effect that these data cannot tell,
                         and why
    controller           Path: YAML with the controller's law (pd, p, cascade),
                         rate, gains, limits, delay, lag; default: pd of 8 Hz
                         per joint, slower where that rings
    seed                 int: of everything that is drawn at random (default 0)
    crop                 Range: of --log to use, s since its first row;
                         default: all (standstill is left out by itself)
    validate_crop        Range: of the logs held out to use; default: all
    changes              bool: of four logs or more of one kind of motion, in
                         the order they were recorded: which parameters changed
                         when
    compliance           Path: diagnosis.json of logs: one over its stiffness
                         is sag
    camera               Logs: of --poses with images: camera_info YAML of ROS;
                         or estimate
    camera_on            str: where the camera is: tool (the board stands),
                         world (the board is on the tool) (default tool)
    length_trust         float, m: standard deviation of the robot file's
                         lengths where they are refined, m (default 0.01)
    angle_trust          float, rad: standard deviation of the robot file's
                         angles where they are refined, and of the base's tilt,
                         rad (default 0.02)
    torque_kind          str: what the log's torque is: auto, link, motor
                         (motor side, times gear ratio), current, command,
                         voltage (default auto)
    torque_constants     Union[float, Sequence[float]]: per joint, N m/A:
                         torque = constant x gear ratio x current; N m/V of
                         voltages
    torque_constants_stddev float: of each joint's torque by which its scale
                         may be off, a standard deviation; default: .05 for
                         currents, .1 for voltages, .02 for torques, 0 for logs
                         of armcal simulate
    gear_ratios          Union[float, Sequence[float]]: per joint; default: 1
    topics               Union[str, Sequence[str]]: topics of ROS 2 bags, as in
                         /joint_states,effort:/torques,wrench:/ft
    export               Union[str, Sequence[str]]: formats to write the robot
                         in
    modules              Union[str, Sequence[str]]: the laws found as sources
                         for the loop of a simulator that lacks them:
                         effects.py, effects.c
    base                 str: (body) that the arm starts at; default: the root
    tip                  str: that the arm ends at, or links, as in
                         left_hand,right_hand; default: the only one
    posture              Mapping[str, float]: where other joints are held, such
                         as a gripper's, rad or m; default: next to 0
    gravity              Union[float, Sequence[float]]: gravity in the base
                         frame, m/s^2; default: the robot file's, for URDF
                         0,0,-9.81
    robot_folder         Path: that files which the robot's MJCF names may lie
                         in; default: its own folder
    out                  Path: for the result files; default: none (simulate:
                         needed)
    flagfile             Path: more flags, one --flag=value a line
    threads              int: that share the work; default: one per core.
                         Results are the same for any number (default 0)
    """

def simulate(
    robot: RobotLike,
    *,
    progress: Progress = None,
    effects: Optional[str] = None,
    list_effects: bool = False,
    robot_error: float = 0.0,
    motion: Path = 'fourier',
    duration: float = 20.0,
    size: float = 0.8,
    speed: float = 1.0,
    log_rate: float = 250.0,
    truth: Optional[Path] = None,
    seed: int = 0,
    run: int = 0,
    joints: Optional[Union[float, Sequence[float]]] = None,
    standstill: float = 1.0,
    controller: Optional[Path] = None,
    friction_width: float = 0.005,
    step: float = 0.001,
    encoder_resolution: Union[float, Sequence[float]] = 5e-06,
    encoder_noise: Union[float, Sequence[float]] = 3e-06,
    torque_noise: Union[float, Sequence[float]] = 0.01,
    coloured_noise: Union[float, Sequence[float]] = 0.005,
    noise_correlation: float = 0.05,
    torque_delay: float = 0.0,
    torque_constants: Optional[Union[float, Sequence[float]]] = None,
    temperature: bool = False,
    jitter: float = 0.0,
    lost: float = 0.0,
    base: Optional[str] = None,
    tip: Optional[str] = None,
    posture: Optional[Mapping[str, float]] = None,
    gravity: Optional[Union[float, Sequence[float]]] = None,
    robot_folder: Optional[Path] = None,
    out: Optional[Path] = None,
    flagfile: Optional[Path] = None,
    threads: int = 0,
) -> Simulation:
    """The log of a simulated robot with hidden effects, and the truth.

    Options:
    effects              str: hidden, NAME[@JOINT][:PARAMETER=VALUE,..] with a
                         semicolon between them; --list_effects shows all
    list_effects         bool: print the effects and their parameters
    robot_error          float: relative standard deviation by which the real
                         robot's masses, inertias and friction differ from the
                         robot file (default 0)
    motion               Path: or what to follow: fourier, points (rests
                         between moves), or a CSV with t,q1..[,qd1..,qdd1..]
                         (default fourier)
    duration             float, s: of a motion that is not from a file (default
                         20)
    size                 float: share of the joints' range that they use
                         (default 0.8)
    speed                float: share of the joints' speed that they use
                         (default 1)
    log_rate             float, Hz: of the log; simulated: has to divide the
                         controller's (default 250)
    truth                Path: for truth.json; default: --out
    seed                 int: of everything that is drawn at random (default 0)
    run                  int: which log of the robot that --seed draws: its
                         motion, noise and what comes and goes are drawn anew
                         (default 0)
    joints               Union[float, Sequence[float]]: that they move;
                         default: all
    standstill           float, s: before and after the motion (default 1)
    controller           Path: YAML with the controller's law (pd, p, cascade),
                         rate, gains, limits, delay, lag; default: pd of 8 Hz
                         per joint, slower where that rings
    friction_width       float: speed within which friction changes sign, rad/s
                         (default 0.005)
    step                 float: of the integration, s (default 0.001)
    encoder_resolution   Union[float, Sequence[float]]: rad or m, one number or
                         one per joint; 0: exact (default 5e-6)
    encoder_noise        Union[float, Sequence[float]]: standard deviation, the
                         same way (default 3e-6)
    torque_noise         Union[float, Sequence[float]]: white, share of each
                         joint's usual torque, one number or one per joint
                         (default 0.01)
    coloured_noise       Union[float, Sequence[float]]: correlated, the same
                         way (default 0.005)
    noise_correlation    float: of the correlated noise, s (default 0.05)
    torque_delay         float: of the log's torques behind positions, s
                         (default 0)
    torque_constants     Union[float, Sequence[float]]: per joint, N m/A:
                         torque = constant x gear ratio x current; N m/V of
                         voltages
    temperature          bool: log the joints' temperatures too
    jitter               float: of the sampling instants, standard deviation, s
                         (default 0)
    lost                 float: share of samples that are lost (default 0)
    base                 str: (body) that the arm starts at; default: the root
    tip                  str: that the arm ends at, or links, as in
                         left_hand,right_hand; default: the only one
    posture              Mapping[str, float]: where other joints are held, such
                         as a gripper's, rad or m; default: next to 0
    gravity              Union[float, Sequence[float]]: gravity in the base
                         frame, m/s^2; default: the robot file's, for URDF
                         0,0,-9.81
    robot_folder         Path: that files which the robot's MJCF names may lie
                         in; default: its own folder
    out                  Path: for the result files; default: none (simulate:
                         needed)
    flagfile             Path: more flags, one --flag=value a line
    threads              int: that share the work; default: one per core.
                         Results are the same for any number (default 0)
    """

def excite(
    robot: RobotLike,
    *,
    given: Union[Logs, Calibration, None] = None,
    progress: Progress = None,
    target: Literal['geometry', 'model', 'physical'] = 'model',
    separate: Optional[Union[str, Sequence[str]]] = None,
    static_poses: int = 0,
    duration: float = 20.0,
    floor: Optional[float] = None,
    obstacles: Optional[Sequence[Sequence[Range]]] = None,
    tool_box: Optional[Sequence[Range]] = None,
    position_limits: Optional[Union[Range, Sequence[Range]]] = None,
    velocity_limits: Optional[Union[float, Sequence[float]]] = None,
    acceleration_limits: Optional[Union[float, Sequence[float]]] = None,
    effort_limits: Optional[Union[float, Sequence[float]]] = None,
    use: float = 0.95,
    criterion: Literal['A', 'D', 'worst'] = 'D',
    periods: int = 1,
    harmonics: int = 0,
    link_radius: float = 0.06,
    log_rate: float = 250.0,
    torque_noise: Union[float, Sequence[float]] = 0.01,
    trust: float = 0.5,
    length_trust: float = 0.01,
    seed: int = 0,
    instrument: Literal['pose', 'target'] = 'target',
    pose_noise: Union[float, Sequence[float]] = (0.0001, 0.0001),
    bandwidth: Optional[float] = None,
    crop: Optional[Range] = None,
    torque_kind: Literal['auto', 'command', 'current', 'link', 'motor', 'voltage'] = 'auto',
    torque_constants: Optional[Union[float, Sequence[float]]] = None,
    torque_constants_stddev: Optional[float] = None,
    gear_ratios: Optional[Union[float, Sequence[float]]] = None,
    topics: Optional[Union[str, Sequence[str]]] = None,
    base: Optional[str] = None,
    tip: Optional[str] = None,
    posture: Optional[Mapping[str, float]] = None,
    gravity: Optional[Union[float, Sequence[float]]] = None,
    robot_folder: Optional[Path] = None,
    out: Optional[Path] = None,
    flagfile: Optional[Path] = None,
    threads: int = 0,
) -> Excitation:
    """A motion, or postures, that show an arm's parameters within its limits.

    given  logs or a Calibration that are there already

    Options:
    target               str: what the motion is to tell: model (parameters),
                         physical (inertias, friction), geometry (lengths)
                         (default model)
    separate             Union[str, Sequence[str]]: effects that the motion, or
                         postures, are to tell apart on every joint, instead of
                         a --target
    static_poses         int: postures for geometry instead of a motion
                         (default 0)
    duration             float, s: of a motion that is not from a file (default
                         20)
    floor                float, m: height over the base that links stay above
    obstacles            Sequence[Sequence[Range]]: that links stay out of:
                         x:x,y:y,z:z[;x:x,y:y,z:z..], m
    tool_box             Sequence[Range]: x:x,y:y,z:z in the base's frame, m,
                         that the tool's point stays in; default: anywhere
    position_limits      Union[Range, Sequence[Range]]:  one or one per joint,
                         rad or m; default: the file's
    velocity_limits      Union[float, Sequence[float]]: rad/s or m/s, one or
                         one per joint; default: the file's
    acceleration_limits  Union[float, Sequence[float]]: rad/s^2 or m/s^2;
                         default: 3 times the velocity in 1 s
    effort_limits        Union[float, Sequence[float]]: N m or N; default: the
                         file's
    use                  float: share of the limits that the motion may use
                         (default 0.95)
    criterion            str: what is to be small: D (volume of the confidence
                         ellipsoid), A (sum of variances), worst (largest
                         standard deviation) (default D)
    periods              int: equal periods that the motion consists of
                         (default 1)
    harmonics            int: of the base frequency, per joint; default: up to
                         0.5 Hz (default 0)
    link_radius          float: of the links, for --floor and --obstacles, m
                         (default 0.06)
    log_rate             float, Hz: of the log; simulated: has to divide the
                         controller's (default 250)
    torque_noise         Union[float, Sequence[float]]: white, share of each
                         joint's usual torque, one number or one per joint
                         (default 0.01)
    trust                float: relative standard deviation of the file's
                         inertias (diagnose: 0.05 without --reference) (default
                         0.5)
    length_trust         float, m: standard deviation of the robot file's
                         lengths where they are refined, m (default 0.01)
    seed                 int: of everything that is drawn at random (default 0)
    instrument           str: what is measured at postures: target (position of
                         a target on the tool), pose (of the tool) (default
                         target)
    pose_noise           Union[float, Sequence[float]]: of what is measured at
                         postures, m and rad (default 0.0001,0.0001)
    bandwidth            float, Hz: cutoff of the low pass; 0: data as they
                         are; default: 10 times the motion's frequency, 8 to 20
                         Hz (watch: 20)
    crop                 Range: of --log to use, s since its first row;
                         default: all (standstill is left out by itself)
    torque_kind          str: what the log's torque is: auto, link, motor
                         (motor side, times gear ratio), current, command,
                         voltage (default auto)
    torque_constants     Union[float, Sequence[float]]: per joint, N m/A:
                         torque = constant x gear ratio x current; N m/V of
                         voltages
    torque_constants_stddev float: of each joint's torque by which its scale
                         may be off, a standard deviation; default: .05 for
                         currents, .1 for voltages, .02 for torques, 0 for logs
                         of armcal simulate
    gear_ratios          Union[float, Sequence[float]]: per joint; default: 1
    topics               Union[str, Sequence[str]]: topics of ROS 2 bags, as in
                         /joint_states,effort:/torques,wrench:/ft
    base                 str: (body) that the arm starts at; default: the root
    tip                  str: that the arm ends at, or links, as in
                         left_hand,right_hand; default: the only one
    posture              Mapping[str, float]: where other joints are held, such
                         as a gripper's, rad or m; default: next to 0
    gravity              Union[float, Sequence[float]]: gravity in the base
                         frame, m/s^2; default: the robot file's, for URDF
                         0,0,-9.81
    robot_folder         Path: that files which the robot's MJCF names may lie
                         in; default: its own folder
    out                  Path: for the result files; default: none (simulate:
                         needed)
    flagfile             Path: more flags, one --flag=value a line
    threads              int: that share the work; default: one per core.
                         Results are the same for any number (default 0)
    """

def inspect(
    robot: RobotLike,
    log: Optional[Logs] = None,
    *,
    fix: bool = False,
    export: Optional[Union[str, Sequence[str]]] = None,
    controller: Optional[Path] = None,
    torque_kind: Literal['auto', 'command', 'current', 'link', 'motor', 'voltage'] = 'auto',
    torque_constants: Optional[Union[float, Sequence[float]]] = None,
    torque_constants_stddev: Optional[float] = None,
    gear_ratios: Optional[Union[float, Sequence[float]]] = None,
    topics: Optional[Union[str, Sequence[str]]] = None,
    base: Optional[str] = None,
    tip: Optional[str] = None,
    posture: Optional[Mapping[str, float]] = None,
    gravity: Optional[Union[float, Sequence[float]]] = None,
    robot_folder: Optional[Path] = None,
    out: Optional[Path] = None,
    flagfile: Optional[Path] = None,
    threads: int = 0,
) -> Inspection:
    """What a robot file or a log holds, and what is wrong with it.

    Options:
    fix                  bool: write the logs as they are understood: order,
                         signs and units
    export               Union[str, Sequence[str]]: formats to write the robot
                         in
    controller           Path: YAML with the controller's law (pd, p, cascade),
                         rate, gains, limits, delay, lag; default: pd of 8 Hz
                         per joint, slower where that rings
    torque_kind          str: what the log's torque is: auto, link, motor
                         (motor side, times gear ratio), current, command,
                         voltage (default auto)
    torque_constants     Union[float, Sequence[float]]: per joint, N m/A:
                         torque = constant x gear ratio x current; N m/V of
                         voltages
    torque_constants_stddev float: of each joint's torque by which its scale
                         may be off, a standard deviation; default: .05 for
                         currents, .1 for voltages, .02 for torques, 0 for logs
                         of armcal simulate
    gear_ratios          Union[float, Sequence[float]]: per joint; default: 1
    topics               Union[str, Sequence[str]]: topics of ROS 2 bags, as in
                         /joint_states,effort:/torques,wrench:/ft
    base                 str: (body) that the arm starts at; default: the root
    tip                  str: that the arm ends at, or links, as in
                         left_hand,right_hand; default: the only one
    posture              Mapping[str, float]: where other joints are held, such
                         as a gripper's, rad or m; default: next to 0
    gravity              Union[float, Sequence[float]]: gravity in the base
                         frame, m/s^2; default: the robot file's, for URDF
                         0,0,-9.81
    robot_folder         Path: that files which the robot's MJCF names may lie
                         in; default: its own folder
    out                  Path: for the result files; default: none (simulate:
                         needed)
    flagfile             Path: more flags, one --flag=value a line
    threads              int: that share the work; default: one per core.
                         Results are the same for any number (default 0)
    """

def reduce(
    robot: RobotLike,
    log: Logs,
    *,
    progress: Progress = None,
    like: Optional[Path] = None,
    unit: Optional[str] = None,
    date: Optional[str] = None,
    bandwidth: Optional[float] = None,
    crop: Optional[Range] = None,
    torque_kind: Literal['auto', 'command', 'current', 'link', 'motor', 'voltage'] = 'auto',
    torque_constants: Optional[Union[float, Sequence[float]]] = None,
    torque_constants_stddev: Optional[float] = None,
    gear_ratios: Optional[Union[float, Sequence[float]]] = None,
    topics: Optional[Union[str, Sequence[str]]] = None,
    geometry: Literal['all_lengths', 'known', 'lengths', 'offsets', 'refine'] = 'known',
    identification: Literal['differential', 'integral', 'weak'] = 'weak',
    loss: Literal['auto', 'cauchy', 'huber', 'squared', 'tukey'] = 'auto',
    joint_terms: Union[str, Sequence[str]] = 'viscous,coulomb,offset,armature',
    coulomb_width: str = 'auto',
    window: Optional[float] = None,
    interval: float = 0.5,
    quadrature: Literal['simpson', 'trapezoid'] = 'trapezoid',
    base: Optional[str] = None,
    tip: Optional[str] = None,
    posture: Optional[Mapping[str, float]] = None,
    gravity: Optional[Union[float, Sequence[float]]] = None,
    robot_folder: Optional[Path] = None,
    out: Optional[Path] = None,
    flagfile: Optional[Path] = None,
    threads: int = 0,
) -> Reduction:
    """What a calibration needs of logs, as factor files.

    log  logs, paths or Logs; like, unit and date are of all of them

    Options:
    like                 Path: factor file whose model these logs are reduced
                         by, so that they can be merged with it
    unit                 str: of the robot that the logs are of
    date                 str: of the logs, UTC: 2026-11-21 or 2026-11-21T10:30
    bandwidth            float, Hz: cutoff of the low pass; 0: data as they
                         are; default: 10 times the motion's frequency, 8 to 20
                         Hz (watch: 20)
    crop                 Range: of --log to use, s since its first row;
                         default: all (standstill is left out by itself)
    torque_kind          str: what the log's torque is: auto, link, motor
                         (motor side, times gear ratio), current, command,
                         voltage (default auto)
    torque_constants     Union[float, Sequence[float]]: per joint, N m/A:
                         torque = constant x gear ratio x current; N m/V of
                         voltages
    torque_constants_stddev float: of each joint's torque by which its scale
                         may be off, a standard deviation; default: .05 for
                         currents, .1 for voltages, .02 for torques, 0 for logs
                         of armcal simulate
    gear_ratios          Union[float, Sequence[float]]: per joint; default: 1
    topics               Union[str, Sequence[str]]: topics of ROS 2 bags, as in
                         /joint_states,effort:/torques,wrench:/ft
    geometry             str: known; lengths (between the joint axes: those the
                         robot file declares unknown, or all that are not zero,
                         are estimated), all_lengths; offsets (joint zeros are
                         refined), refine (all of the file's geometry is)
                         (default known)
    identification       str: weak (test functions, no acceleration),
                         differential (2.19), integral (2.27) (default weak)
    loss                 str: what large residuals count: auto (huber for
                         torques, tukey for poses), huber, cauchy, tukey,
                         squared (all alike, and no gross error is taken out of
                         the torque) (default auto)
    joint_terms          Union[str, Sequence[str]]: what joints add to the
                         rigid arm, or none (default
                         viscous,coulomb,offset,armature)
    coulomb_width        str: how Coulomb friction changes sign: auto (fitted
                         per joint), a speed such as 0.02rad/s, or a
                         displacement such as 0.001rad, for all joints (default
                         auto)
    window               float, s: length of the weak form's test functions, s;
                         default: .87 periods of the bandwidth, to 0.3 for
                         noise
    interval             float, s: integral model: length of intervals (default
                         0.5)
    quadrature           str: integral model: trapezoid, simpson (default
                         trapezoid)
    base                 str: (body) that the arm starts at; default: the root
    tip                  str: that the arm ends at, or links, as in
                         left_hand,right_hand; default: the only one
    posture              Mapping[str, float]: where other joints are held, such
                         as a gripper's, rad or m; default: next to 0
    gravity              Union[float, Sequence[float]]: gravity in the base
                         frame, m/s^2; default: the robot file's, for URDF
                         0,0,-9.81
    robot_folder         Path: that files which the robot's MJCF names may lie
                         in; default: its own folder
    out                  Path: for the result files; default: none (simulate:
                         needed)
    flagfile             Path: more flags, one --flag=value a line
    threads              int: that share the work; default: one per core.
                         Results are the same for any number (default 0)
    """

def merge(
    robot: RobotLike,
    factors: Any,
    *,
    progress: Progress = None,
    base: Optional[str] = None,
    tip: Optional[str] = None,
    posture: Optional[Mapping[str, float]] = None,
    gravity: Optional[Union[float, Sequence[float]]] = None,
    robot_folder: Optional[Path] = None,
    out: Optional[Path] = None,
    flagfile: Optional[Path] = None,
    threads: int = 0,
) -> Merger:
    """The calibration that factor files give together, and what units of one
    robot have in common, differ in and drift by.

    factors  factor files, folders of them, or Reductions, one or a list

    Options:
    base                 str: (body) that the arm starts at; default: the root
    tip                  str: that the arm ends at, or links, as in
                         left_hand,right_hand; default: the only one
    posture              Mapping[str, float]: where other joints are held, such
                         as a gripper's, rad or m; default: next to 0
    gravity              Union[float, Sequence[float]]: gravity in the base
                         frame, m/s^2; default: the robot file's, for URDF
                         0,0,-9.81
    robot_folder         Path: that files which the robot's MJCF names may lie
                         in; default: its own folder
    out                  Path: for the result files; default: none (simulate:
                         needed)
    flagfile             Path: more flags, one --flag=value a line
    threads              int: that share the work; default: one per core.
                         Results are the same for any number (default 0)
    """

def compare(
    results: Any,
    *,
    robot: Optional[RobotLike] = None,
    log: Optional[Logs] = None,
    progress: Progress = None,
    crop: Optional[Range] = None,
    bandwidth: Optional[float] = None,
    torque_kind: Literal['auto', 'command', 'current', 'link', 'motor', 'voltage'] = 'auto',
    torque_constants: Optional[Union[float, Sequence[float]]] = None,
    torque_constants_stddev: Optional[float] = None,
    gear_ratios: Optional[Union[float, Sequence[float]]] = None,
    topics: Optional[Union[str, Sequence[str]]] = None,
    base: Optional[str] = None,
    tip: Optional[str] = None,
    posture: Optional[Mapping[str, float]] = None,
    gravity: Optional[Union[float, Sequence[float]]] = None,
    robot_folder: Optional[Path] = None,
    out: Optional[Path] = None,
    flagfile: Optional[Path] = None,
    threads: int = 0,
) -> Comparison:
    """Whether results of one robot agree within noise.

    results  two or more: Calibrations, Diagnoses, Verifications, their files or
             folders, or robot files
    robot    of log; what calibrations are of
    log      held out: what calibrations and robots leave of its torques

    Options:
    crop                 Range: of --log to use, s since its first row;
                         default: all (standstill is left out by itself)
    bandwidth            float, Hz: cutoff of the low pass; 0: data as they
                         are; default: 10 times the motion's frequency, 8 to 20
                         Hz (watch: 20)
    torque_kind          str: what the log's torque is: auto, link, motor
                         (motor side, times gear ratio), current, command,
                         voltage (default auto)
    torque_constants     Union[float, Sequence[float]]: per joint, N m/A:
                         torque = constant x gear ratio x current; N m/V of
                         voltages
    torque_constants_stddev float: of each joint's torque by which its scale
                         may be off, a standard deviation; default: .05 for
                         currents, .1 for voltages, .02 for torques, 0 for logs
                         of armcal simulate
    gear_ratios          Union[float, Sequence[float]]: per joint; default: 1
    topics               Union[str, Sequence[str]]: topics of ROS 2 bags, as in
                         /joint_states,effort:/torques,wrench:/ft
    base                 str: (body) that the arm starts at; default: the root
    tip                  str: that the arm ends at, or links, as in
                         left_hand,right_hand; default: the only one
    posture              Mapping[str, float]: where other joints are held, such
                         as a gripper's, rad or m; default: next to 0
    gravity              Union[float, Sequence[float]]: gravity in the base
                         frame, m/s^2; default: the robot file's, for URDF
                         0,0,-9.81
    robot_folder         Path: that files which the robot's MJCF names may lie
                         in; default: its own folder
    out                  Path: for the result files; default: none (simulate:
                         needed)
    flagfile             Path: more flags, one --flag=value a line
    threads              int: that share the work; default: one per core.
                         Results are the same for any number (default 0)
    """
