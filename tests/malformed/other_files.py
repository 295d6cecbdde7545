"""Poses, factor files, calibrations, controllers, motions and covariances."""

import hashlib
import json
import math
import pathlib
import struct

from inputs import (LOG, Group, Row, a_folder, both, compressed, cut, edited, linked,
                    nothing, padded, removed, replaced, written)

# Two links that swing, which can be simulated; their log and what comes of it.
SWINGING = (pathlib.Path(__file__).resolve().parent.parent /
            "swinging_arm.yaml").read_text().replace("name: swing", "name: arm")
SIMULATE = "simulate --robot=robot.yaml --duration=5 --log_rate=100 --out=."
REDUCE = "reduce --robot=robot.yaml --log=log.csv --out=factors"
CALIBRATE = "calibrate --robot=robot.yaml --log=log.csv --out=made"
FACTOR = "factors/log.factor"


def of_factor(edit):
    return edited(FACTOR, edit)


def resealed(edit):
    """Its header's JSON edited, and the checksum made to fit again."""
    def whole(data):
        start = data.index(b"\n") + 1
        size, = struct.unpack_from("<Q", data, start)
        header = json.loads(data[start + 8:start + 8 + size])
        edit(header)
        text = json.dumps(header).encode()
        body = (data[:start] + struct.pack("<Q", len(text)) + text +
                data[start + 8 + size:-32])
        return body + hashlib.sha256(body).digest()
    return of_factor(whole)


def sealed(body):
    return body + hashlib.sha256(body).digest()


def header_text(text, size=None):
    data = text.encode()
    return sealed(b"armcal factor 1\n" + struct.pack(
        "<Q", len(data) if size is None else size) + data)


def sets(*path_and_value):
    """Sets data[a][b].. to the last of the arguments; None: takes it away."""
    *path, last, value = path_and_value

    def edit(data):
        for key in path:
            data = data[key]
        if value is None:
            del data[last]
        else:
            data[last] = value
    return edit


FACTORS = Group("factor file", "merge --robot=robot.yaml --factors=factors --out=out",
                {"robot.yaml": SWINGING}, [
    Row("missing", nothing,
        "absent.factor: cannot be opened: No such file or directory", "merge --robot=robot.yaml --factors=absent.factor"),
    Row("folder without", removed(FACTOR),
        "factors: holds no .factor files"),
    Row("folder in its place", lambda folder: (folder / "factors/x.factor").mkdir(),
        "factors/x.factor: is a folder: expected a file"),
    Row("endless zeros", linked("factors/x.factor", "/dev/zero"),
        "factors/x.factor: found '                    ': expected a factor file, as armcal "
        "reduce writes it"),
    Row("empty", of_factor(lambda x: b""),
        "factors/log.factor: expected a factor file, as armcal reduce writes it"),
    Row("CSV", of_factor(lambda x: LOG.encode()),
        "factors/log.factor: found 't,q1,q2,tau1,tau2 1.': expected a factor file, as "
        "armcal reduce writes it"),
    Row("cut", of_factor(lambda x: x[:-100]),
        "factors/log.factor: checksum: does not fit the content: the file is damaged or not "
        "whole; reduce the log again"),
    Row("first line alone", of_factor(lambda x: b"armcal factor 1\n"),
        "factors/log.factor: ends too early: it was not written whole"),
    Row("another version", of_factor(lambda x: x.replace(b"factor 1\n", b"factor 2\n", 1)),
        "factors/log.factor: version: found '2': expected 1; a newer armcal wrote this, or "
        "none"),
    Row("bit changed", of_factor(lambda x: x[:-50] + bytes([x[-50] ^ 1]) + x[-49:]),
        "factors/log.factor: checksum: does not fit the content: the file is damaged or not "
        "whole; reduce the log again"),
    Row("header no JSON", of_factor(lambda x: header_text("armcal")),
        "factors/log.factor: byte 1: expected JSON, as armcal writes it"),
    Row("header cut", of_factor(lambda x: header_text('{"model": ')),
        "factors/log.factor: byte 11: expected JSON, as armcal writes it"),
    Row("header longer than the file", of_factor(lambda x: header_text("{}", 1 << 63)),
        "factors/log.factor: ends too early for what it announces"),
    Row("header of nested lists", of_factor(lambda x: header_text("[" * 100000 + "]" * 100000)),
        "factors/log.factor: expected JSON, as armcal writes it: lists and objects are "
        "nested too deeply"),
    Row("numbers missing", of_factor(lambda x: sealed(x[:-132])),
        "factors/log.factor: ends too early for what it announces"),
    Row("10000 columns", resealed(sets("logs", 0, "columns", [10000, 10000])),
        "factors/log.factor: ends too early for what it announces"),
    Row("columns of -1", resealed(sets("logs", 0, "columns", [-1, 7])),
        "factors/log.factor: key logs[0].columns[0]: found '-1': expected a whole number of "
        "at least 0"),
    Row("columns of one joint", resealed(sets("logs", 0, "columns", [9])),
        "factors/log.factor: key logs[0].columns: found '[9]': expected as many numbers as "
        "rows has, of at most 10000"),
    Row("rows beyond 64 bits", resealed(sets("logs", 0, "rows", [1e300, 1e300])),
        "factors/log.factor: key logs[0].rows[0]: found '1e+300': expected a whole number "
        "of at least 0"),
    Row("hops beyond 32 bits", resealed(sets("model", "hops", 1e300)),
        "factors/log.factor: key model.hops: found '1e+300': expected a whole number of at "
        "least 0"),
    Row("window of 0 s", resealed(sets("model", "window_s", 0)),
        "factors/log.factor: key model.window_s: found '0': expected a number above 0"),
    Row("samples of -1", resealed(sets("logs", 0, "samples", -1)),
        "factors/log.factor: key logs[0].samples: found '-1': expected a whole number of at "
        "least 0"),
    Row("loss unknown", resealed(sets("model", "loss", "cubic")),
        'factors/log.factor: key model.loss: found \'"cubic"\': expected a word that this '
        "armcal knows"),
    Row("gravity of two numbers", resealed(sets("model", "gravity", [0, 1])),
        "factors/log.factor: key model.gravity: found '[0,1]': expected 3 numbers"),
    Row("parameter unknown", resealed(sets("model", "parameters", 0, "Izz[9]")),
        "factors/log.factor: key model.parameters: expected those of arm, with the same "
        "--base, --tip and --gravity"),
    Row("key missing", resealed(sets("model", "geometry", None)),
        "factors/log.factor: key model.geometry: is missing; expected a file that armcal "
        "wrote"),
    Row("key of another type", resealed(sets("logs", {"a": 1})),
        'factors/log.factor: key logs: found \'{"a":1}\': expected a list'),
    Row("no logs", resealed(sets("logs", [])),
        "factors/log.factor: key logs: found '[]': expected at least one log"),
    Row("number nan", of_factor(lambda x: sealed(x[:-40] + b"\xff" * 8)),
        "factors/log.factor: found '-nan': expected a finite number in the factors"),
    Row("another robot", replaced("robot.yaml", "mass: 5", "mass: 6"),
        "factors/log.factor: key model.robot_sha256: found "
        "'a9eacf846d16cc0066ac980892eab4613c9f502ce9340006bf1950c869ed702c': expected "
        "228a7a9ddd529172f475c42eef6a1bc854ea2e466243d33f781cdf2c8c810bbf, that of "
        "robot.yaml"),
])


def of_json(name, edit):
    def change(folder):
        data = json.loads((folder / name).read_text())
        edit(data)
        (folder / name).write_text(json.dumps(data))
    return change


def calibration(*path_and_value):
    return of_json("made/calibration.json", sets(*path_and_value))


CALIBRATIONS = Group(
    "calibration.json", "verify --robot=robot.yaml --calibration=made/calibration.json --out=out",
    {"robot.yaml": SWINGING}, [
    Row("missing", removed("made/calibration.json"),
        "made/calibration.json: cannot be opened: No such file or directory"),
    Row("folder", a_folder("made/calibration.json"),
        "made/calibration.json: is a folder: expected a file"),
    Row("empty", written("made/calibration.json", ""),
        "made/calibration.json: the file is empty"),
    Row("endless zeros", linked("made/calibration.json", "/dev/zero"),
        "made/calibration.json: is larger than 16 MiB, the most that such a file may have"),
    Row("96 MiB", padded("made/calibration.json", 96 << 20),
        "made/calibration.json: is larger than 16 MiB, the most that such a file may have"),
    Row("cut", cut("made/calibration.json", 2000),
        "made/calibration.json: byte 2001: expected JSON, as armcal writes it"),
    Row("YAML", written("made/calibration.json", SWINGING),
        "made/calibration.json: byte 2: expected JSON, as armcal writes it"),
    Row("NaN", replaced("made/calibration.json", '"bandwidth_hz": 8.0', '"bandwidth_hz": NaN'),
        "made/calibration.json: byte 21: expected JSON, as armcal writes it"),
    Row("not UTF-8", replaced("made/calibration.json", '"bandwidth_hz": 8.0', b'"bandwidth_hz": "\xff\xfe"'),
        "made/calibration.json: byte 22: expected JSON, as armcal writes it"),
    Row("1e999", replaced("made/calibration.json", '"bandwidth_hz": 8.0', '"bandwidth_hz": 1e999'),
        "made/calibration.json: expected JSON, as armcal writes it: a number is too large"),
    Row("a million nested lists", written("made/calibration.json", lambda: "[" * 1000000 + "]" * 1000000),
        "made/calibration.json: expected JSON, as armcal writes it: lists and objects are "
        "nested too deeply"),
    Row("a list", written("made/calibration.json", "[]"),
        "made/calibration.json: found '[]': expected an object"),
    Row("no object of armcal", written("made/calibration.json", "{}"),
        "made/calibration.json: key format: is missing; expected a file that armcal wrote"),
    Row("another format", calibration("format", "armcal calibration 2"),
        'made/calibration.json: key format: found \'"armcal calibration 2"\': expected '
        "'armcal calibration 1', the format this version reads"),
    Row("another robot", calibration("robot", "scara"),
        'made/calibration.json: key robot: found \'"scara"\': expected \'arm\', the robot of '
        "--robot: this is a calibration of another robot"),
    Row("linear estimate", calibration("estimate", "linear"),
        'made/calibration.json: key estimate: found \'"linear"\': expected \'refined\': a '
        "simulation needs links that can exist; run armcal calibrate --estimate=refined "
        "with a robot file that gives every link a mass"),
    Row("one joint", calibration("joints", []),
        "made/calibration.json: key joints: found '[]': expected 2 joints, as the robot of "
        "--robot has"),
    Row("joint of another name", calibration("joints", 1, "name", "wrist"),
        'made/calibration.json: key joints[1].name: found \'"wrist"\': expected \'joint2\', the '
        "robot of --robot: this is a calibration of another robot"),
    Row("parameters missing", calibration("parameters", None),
        "made/calibration.json: key parameters: is missing; expected a file that armcal "
        "wrote"),
    Row("parameter missing", calibration("parameters", 0, None),
        "made/calibration.json: key parameters: expected an entry for link1.mass"),
    Row("parameter twice", calibration("parameters", 1, "name", "link1.mass"),
        'made/calibration.json: key parameters[1].name: found \'"link1.mass"\': expected '
        "every parameter only once"),
    Row("parameter unknown", calibration("parameters", 0, "name", "link9.mass"),
        'made/calibration.json: key parameters[0].name: found \'"link9.mass"\': expected a '
        "parameter of the robot of --robot"),
    Row("parameter of another unit", calibration("parameters", 0, "unit", "g"),
        'made/calibration.json: key parameters[0].unit: found \'"g"\': expected \'kg\', the '
        "unit of link1.mass"),
    Row("parameter of another prior", calibration("parameters", 0, "prior", 7),
        "made/calibration.json: key parameters[0].prior: found '7': expected 5, what the "
        "robot file has for link1.mass: give the file that was calibrated, or calibrate "
        "again"),
    Row("value negative", calibration("parameters", 0, "value", -1),
        "made/calibration.json: key parameters[0].value: found '-1': expected a number of "
        "at least 0, as link1.mass is"),
    Row("value a text", calibration("parameters", 0, "value", "5 kg"),
        'made/calibration.json: key parameters[0].value: found \'"5 kg"\': expected a finite '
        "number"),
    Row("value null", calibration("parameters", 0, "value", [None]),
        "made/calibration.json: key parameters[0].value: found '[null]': expected a finite "
        "number"),
    Row("transition of another law", calibration("joints", 0, "coulomb_transition", "law", "time"),
        'made/calibration.json: key joints[0].coulomb_transition.law: found \'"time"\': '
        "expected 'velocity' or 'displacement'"),
    Row("transition of width 0", calibration("joints", 0, "coulomb_transition", "width", 0),
        "made/calibration.json: key joints[0].coulomb_transition.width: found '0': expected "
        "a width of at least 1e-09"),
    Row("transition missing", calibration("joints", 0, "coulomb_transition", None),
        "made/calibration.json: key joints[0].coulomb_transition: is missing; expected a "
        "file that armcal wrote"),
    Row("bandwidth negative", calibration("bandwidth_hz", -1),
        "made/calibration.json: key bandwidth_hz: found '-1': expected a frequency in Hz, "
        "or 0"),
])

GIVEN = Group(
    "given calibration", "excite --robot=robot.yaml --given=made/calibration.json --duration=2 --out=out",
    {"robot.yaml": SWINGING}, [
    Row("density 0", calibration("joints", 0, "noise_density", 0),
        "made/calibration.json: key joints[0].noise_density: found '0': expected more than "
        "0"),
    Row("covariance missing", removed("made/covariance.csv"),
        "made/covariance.csv: cannot be opened: No such file or directory"),
    Row("covariance empty", written("made/covariance.csv", ""),
        "made/covariance.csv: the file is empty"),
    Row("covariance names alone", cut("made/covariance.csv", 150),
        "made/covariance.csv: row 2: expected 13 rows below the names, one per parameter"),
    Row("covariance ragged", edited("made/covariance.csv", lambda x: x.replace(b",", b"\n", 20)),
        'made/covariance.csv: row 2, column 1: found \'"hx[1]"\': expected a number or '
        "nothing"),
    Row("covariance of words", edited("made/covariance.csv", lambda x: x.replace(b"\n", b"\nsmall,", 1)),
        "made/covariance.csv: row 2, column 1: found 'small': expected a number or nothing"),
    Row("covariance not symmetric", edited("made/covariance.csv", lambda x: x.replace(b"e-05", b"e+05", 2)),
        "made/covariance.csv: expected a symmetric matrix below the names"),
    Row("covariance outside", calibration("covariance", "file", "../../../../etc/passwd"),
        "made/passwd: cannot be opened: No such file or directory"),
    Row("covariance of /etc/passwd", both(
        calibration("covariance", "file", "/etc/passwd"), removed("made/covariance.csv")),
        "made/passwd: cannot be opened: No such file or directory"),
    Row("name that is no parameter", calibration("covariance", "names", 0, "Izz[9]"),
        'made/calibration.json: key covariance.names[0]: found \'"Izz[9]"\': expected a '
        "parameter of the model that the motion is for: give the logs of this calibration "
        "instead"),
])

POSES = "q1,q2,x1,y1,z1\n" + "".join(
    f"{k / 10:g},{(k * k) % 7 / 5:g},{0.5 - k / 90:g},{k / 20:g},0\n" for k in range(20))


def poses(old, new):
    return replaced("poses.csv", old, new)


def pose_row(number, text):
    return edited("poses.csv", lambda x: b"\n".join(
        text.encode() if k + 1 == number else line for k, line in enumerate(x.splitlines())) + b"\n")


POSE_FILES = Group("poses", "calibrate --robot=robot.yaml --poses=poses.csv --out=out",
                   {"robot.yaml": SWINGING, "poses.csv": POSES}, [
    Row("missing", removed("poses.csv"),
        "poses.csv: cannot be opened: No such file or directory"),
    Row("empty", written("poses.csv", ""),
        "poses.csv: the file is empty"),
    Row("folder", a_folder("poses.csv"),
        "poses.csv: is a folder without a bag: expected one of rosbag2, with metadata.yaml "
        "and .db3 or .mcap files"),
    Row("header alone", written("poses.csv", "q1,q2,x1,y1,z1\n"),
        "poses.csv: the file has a header and no rows"),
    Row("no measurement", poses("x1,y1,z1", "a,b,c"),
        "poses.csv: row 1: expected one kind of measurement: x1 y1 z1 [x2 ..] (targets), x "
        "y z qw qx qy qz (poses), length1 (a wire), point or plane (touched ones), "
        "tilt_x tilt_y (an inclinometer)"),
    Row("coordinate missing", poses("x1,y1,z1", "x1,y1,height"),
        "poses.csv: row 1: the column z1 is missing"),
    Row("coordinate twice", poses("x1,y1,z1", "x1,y1,y1"),
        "poses.csv: row 1: found 'y1': the column is there twice"),
    Row("two kinds", poses("x1,y1,z1", "length1,u95_1,z1"),
        "poses.csv: row 1: the column x1, y1 is missing"),
    Row("unit", poses("x1,y1,z1", "x1 [inch],y1,z1"),
        "poses.csv: row 1, column x1 [inch]: found 'inch': expected the unit m or mm"),
    Row("joint missing", poses("q1,q2", "q1,p2"),
        "poses.csv: row 1: missing q2 or joint2/position; the robot has 2 joints, the log "
        "holds q1; not recognised: 'p2', 'x1', 'y1', 'z1'"),
    Row("nan", pose_row(4, "0.1,0.2,nan,0.3,0"),
        "poses.csv: row 4, column x1: found 'nan': expected a finite number"),
    Row("short row", pose_row(4, "0.1,0.2,0.3,0.3"),
        "poses.csv: row 4: found '4 fields': expected 5 as in the header"),
    Row("decimal comma", edited("poses.csv", lambda x: x.replace(b",", b";").replace(b".", b",")),
        "poses.csv: row 2, column x1: found '0,5': expected a finite number with a decimal "
        "point, not a comma"),
    Row("wire of negative length", written("poses.csv", "q1,q2,length1\n0,0,1\n0,1,-1\n"),
        "poses.csv: row 3, column length1: found '-1': expected a length above 0"),
    Row("uncertainty below 0", written(
        "poses.csv", "q1,q2,length1,u95_1\n0,0,1,0\n0,1,1,-0.1\n"),
        "poses.csv: row 3, column u95_1: found '-0.1': expected an uncertainty of at least 0 "
        "(0: not stated)"),
    Row("quaternion not of length 1", written(
        "poses.csv", "q1,q2,x,y,z,qw,qx,qy,qz\n0,0,0,0,0,1,0,0,0\n0,1,0,0,0,1,1,0,0\n"),
        "poses.csv: row 3, column qw: found '1 1 0 0': expected a unit quaternion"),
    Row("gzip bomb", written("poses.csv", compressed("q1,q2,x1,y1,z1\n" + "0,0,0,0,0\n" * 100000, 100)),
        "poses.csv: row 100002: expected at most 100000 poses, which all are kept in memory"),
    Row("gzip bomb of rows", written("poses.csv", lambda: (
        compressed("q1,q2,x1,y1,z1\n")() + compressed("0,0,0,0,0\n" * 100000, 200)())),
        "poses.csv: row 100002: expected at most 100000 poses, which all are kept in memory"),
    Row("endless zeros", linked("poses.csv", "/dev/zero"),
        "poses.csv: row 1: a NUL byte: the file is binary or UTF-16, or was being written "
        "when the power went"),
])

CONTROLLER = "rate: 1000\nkp: [3000, 500]\nkd: [120, 20]\n"


def controller(old, new):
    return replaced("controller.yaml", old, new)


COMMANDS = Group(
    "commands instead of torques",
    "diagnose --robot=robot.yaml --log=log.csv --controller=controller.yaml --out=out",
    {"robot.yaml": SWINGING, "controller.yaml": CONTROLLER + "ki: [0, 0]\n",
     "log.csv": "t,q1,q2,qref1,qref2\n" + "".join(
         f"{k / 100:g},{.5 * math.sin(k / 60):.9g},{.4 * math.sin(k / 40):.9g},"
         f"{.52 * math.sin(k / 60 + .05):.9g},{.41 * math.sin(k / 40 + .05):.9g}\n"
         for k in range(1200))}, [
    Row("neither torque nor command", replaced("log.csv", "qref", "other"),
        "log.csv: row 1: no torque: missing tau1 or joint1/effort, tau2 or joint2/effort; or "
        "currents (i1 or joint1/current, ..) or voltages (u1, ..) with --torque_constants; "
        "not recognised: 'other1', "
        "'other2'"),
])

SIMULATIONS = Group(
    "simulation",
    "simulate --robot=robot.yaml --controller=controller.yaml --motion=motion.csv --out=out",
    {"robot.yaml": SWINGING, "controller.yaml": CONTROLLER,
     "motion.csv": "t,q1,q2\n" + "".join(f"{k / 20:g},{k / 90:g},{k / 60:g}\n" for k in range(20))}, [
    Row("controller missing", removed("controller.yaml"),
        "controller.yaml: cannot be opened: No such file or directory"),
    Row("controller empty", written("controller.yaml", ""),
        "controller.yaml: the file is empty"),
    Row("controller a list", written("controller.yaml", "[1, 2]\n"),
        "controller.yaml: line 1: found '[1, 2]': expected a map with the keys law, rate, "
        "bandwidth, kp, kd, ki, position_gain, velocity_ki, velocity_feedforward, "
        "velocity_limit, torque_limit, lag, delay, velocity_filter, feedforward"),
    Row("controller of endless zeros", linked("controller.yaml", "/dev/zero"),
        "controller.yaml: is larger than 1 MiB, the most that such a file may have"),
    Row("rate 0", controller("1000", "0"),
        "controller.yaml: line 1, rate: found '0': expected a number above 0, in Hz"),
    Row("rate of 1 GHz", controller("1000", "1e9"),
        "controller.yaml: line 1, rate: found '1e9': expected a rate from 1 to 20000 Hz"),
    Row("rate nan", controller("1000", "nan"),
        "controller.yaml: line 1, rate: found 'nan': expected a finite number in Hz"),
    Row("kp of one number", controller("[3000, 500]", "[3000]"),
        "controller.yaml: line 2, kp: found '[3000]': expected 2 numbers, one per joint, in "
        "N m/rad (N/m)"),
    Row("kp negative", controller("[3000, 500]", "[3000, -500]"),
        "controller.yaml: line 2, kp: found '[3000, -500]': expected numbers of at least 0"),
    Row("kp a number", controller("[3000, 500]", "3000"),
        "controller.yaml: line 2, kp: found '3000': expected a list of numbers in N m/rad "
        "(N/m)"),
    Row("kp of words", controller("[3000, 500]", "[high, low]"),
        "controller.yaml: line 2, kp[1]: found 'high': expected a number in N m/rad (N/m)"),
    Row("controller key unknown", controller("kd", "k_d"),
        "controller.yaml: line 3: found 'k_d': expected one of the keys law, rate, "
        "bandwidth, kp, kd, ki, position_gain, velocity_ki, velocity_feedforward, "
        "velocity_limit, torque_limit, lag, delay, velocity_filter, feedforward"),
    Row("law unknown", controller("rate: 1000", "law: pid"),
        "controller.yaml: line 1, law: found 'pid': expected one of pd, p, cascade"),
    Row("kp of a cascade", controller("rate: 1000", "law: cascade"),
        "controller.yaml: line 2, kp: found '[3000, 500]': expected no such key: law cascade "
        "has no kp"),
    Row("velocity limit without a velocity loop", controller("rate: 1000", "velocity_limit: [1, 2]"),
        "controller.yaml: line 1, velocity_limit: found '[1, 2]': expected no such key: law pd "
        "has no velocity_limit"),
    Row("delay in milliseconds", controller("rate: 1000", "delay: 4"),
        "controller.yaml: line 1, delay: found '4': expected at most 1 s; is it in "
        "milliseconds?"),
    Row("delay negative", controller("rate: 1000", "delay: -.004"),
        "controller.yaml: line 1, delay: found '-.004': expected a number in s that is not "
        "negative"),
    Row("lag in milliseconds", controller("rate: 1000", "lag: [1, 2]"),
        "controller.yaml: line 1, lag: found '[1, 2]': expected at most 1 s; is it in "
        "milliseconds?"),
    Row("feedforward unknown", controller("rate: 1000", "feedforward: perfect"),
        "controller.yaml: line 1, feedforward: found 'perfect': expected one of none, "
        "gravity, inverse_dynamics"),
    Row("feedforward a tag", controller("rate: 1000", "feedforward: !!python/name:os.system x"),
        "controller.yaml: line 1, feedforward: found 'x': expected one of none, gravity, "
        "inverse_dynamics"),
    Row("motion missing", removed("motion.csv"),
        "motion.csv: cannot be opened: No such file or directory"),
    Row("motion of three rows", written("motion.csv", "t,q1,q2\n0,0,0\n1,1,1\n2,2,2\n"),
        "motion.csv: found '3 rows': expected at least 4 to follow"),
    Row("motion whose time stands still", replaced("motion.csv", "0.1,", "0.05,"),
        "motion.csv: row 4: its time is that of the row before; expected a motion whose "
        "times rise"),
    Row("motion of a million seconds", replaced("motion.csv", "0.95,", "1e6,"),
        "motion.csv: found '1e+06 s': expected a motion of at most 10000 s; is its time in "
        "ms?"),
    Row("motion of nan", replaced("motion.csv", "0.1,", "0.1,nan"),
        "motion.csv: row 4, column q1: found 'nan0.0222222': expected a finite number"),
    Row("motion of one joint", replaced("motion.csv", "q2", "x"),
        "motion.csv: row 1: missing q2 or joint2/position; the robot has 2 joints, the log "
        "holds q1; not recognised: 'x'"),
    Row("link without mass", replaced("robot.yaml", "mass: 3, com: [-.15, 0, 0], inertia: [.01, .03, .03],", ""),
        "robot.yaml: link link2: it has no mass; expected a robot file whose links have "
        "inertias, to simulate"),
    Row("effect of a size it cannot have", nothing,
        "arm: effect payload: mass = -50: expected 0.0005 to 0.6",
        "simulate --robot=robot.yaml --effects=payload:mass=-50 --out=out"),
])

WATCHED = Group(
    "watched log", "watch --robot=robot.yaml --calibration=made --log=log.csv --follow "
    "--idle=0.2 --quiet --out=out", {"robot.yaml": SWINGING}, [
    Row("missing", removed("log.csv"), "log.csv: cannot be opened: No such file or directory"),
    Row("folder", a_folder("log.csv"),
        "log.csv: is a folder: a bag that is being written cannot be followed; print its "
        "topic into a pipe instead (docs/watch.md has the lines)"),
    Row("empty", written("log.csv", ""), "log.csv: the file is empty"),
    Row("header alone", written("log.csv", "t,q1,q2,tau1,tau2\n"),
        "log.csv: expected two rows of different times"),
    Row("one instant", written("log.csv", "t,q1,q2,tau1,tau2\n" + 99 * "0,1,2,3,4\n"),
        "log.csv: expected two rows of different times"),
    Row("no torque of a joint", written("log.csv", "t,q1,q2,tau1\n0,1,2,3\n"),
        "log.csv: row 1: missing tau2 or joint2/effort; the robot has 2 joints, the log "
        "holds tau1"),
    Row("endless zeros", linked("log.csv", "/dev/zero"),
        "log.csv: is no text: only CSV can be followed while it is written; unpack it, or "
        "watch it when it is finished"),
    Row("gzip", written("log.csv", compressed(LOG)),
        "log.csv: is no text: only CSV can be followed while it is written; unpack it, or "
        "watch it when it is finished"),
    Row("MCAP", written("log.csv", b"\x89MCAP0\r\n"),
        "log.csv: is a bag: one that is being written cannot be followed, as its messages "
        "are found by what is written last; print its topic into a pipe instead "
        "(docs/watch.md has the lines), or watch the bag when it is finished"),
    Row("endless line", written("log.csv", lambda: "t," + "q" * (3 << 20)),
        "log.csv: row 1: the line is longer than 1 MB; this is not a log in CSV"),
    Row("words", written("log.csv", "t,q1,q2,tau1,tau2\n" + 2000 * "a,b,c,d,e\n"),
        "log.csv: row 1001: 1000 rows in a row could not be used, the last one because: "
        "log.csv: row 1001, column q1: found 'b': expected a finite number"),
    Row("posterior missing", removed("made/parameters_posterior.csv"),
        "made/parameters_posterior.csv: cannot be opened: No such file or directory"),
])

GROUPS = [FACTORS._replace(prepare=[SIMULATE, REDUCE]),
          CALIBRATIONS._replace(prepare=[SIMULATE, CALIBRATE]),
          GIVEN._replace(prepare=[SIMULATE, CALIBRATE]),
          WATCHED._replace(prepare=[SIMULATE, CALIBRATE]), POSE_FILES, SIMULATIONS, COMMANDS]
