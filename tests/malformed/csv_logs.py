"""Logs in CSV, plain or gzipped."""

import bz2

from inputs import (ARM, HEADER, LOG, SAMPLES, Group, Row, a_folder, both, compressed,
                    cut, edited, headed, linked, nothing, padded, removed, with_row, written)


def epoch(decimals):
    """Samples at 1 ms, whose stamps count 10^-decimals s since 1970."""
    return HEADER + "\n" + "".join(
        f"{17 * 10**(8 + decimals) + k * 10**(decimals - 3)},{k / 100:g},0.5,2,1\n"
        for k in range(40))


JSON = ("log.csv: row 1: is JSON, expected CSV, NumPy's .npz, MATLAB's .mat or a bag of ROS 2: "
        "load it in Python and write its lists with numpy.savez, or its records with "
        "pandas.DataFrame(records).to_csv")

GROUPS = [Group(
    "csv", "calibrate --robot=robot.yaml --log=log.csv --out=out",
    {"robot.yaml": ARM, "log.csv": LOG}, [

    # No file, or none of this kind.
    Row("missing", removed("log.csv"),
        "log.csv: cannot be opened: No such file or directory"),
    Row("empty", written("log.csv", ""),
        "log.csv: the file is empty"),
    Row("blank", written("log.csv", "\n\n \n"),
        "log.csv: row 1: the row is empty, expected names of columns, as in t,q1,tau1"),
    Row("header alone", written("log.csv", HEADER + "\n"),
        "log.csv: the log has a header and no rows"),
    Row("folder", a_folder("log.csv"),
        "log.csv: is a folder without a bag: expected one of rosbag2, with metadata.yaml "
        "and .db3 or .mcap files"),
    Row("unreadable", linked("log.csv", "/proc/self/mem"),
        "log.csv: cannot be read: Input/output error"),
    Row("endless zeros", linked("log.csv", "/dev/zero"),
        "log.csv: row 1: a NUL byte: the file is binary or UTF-16, or was being written "
        "when the power went"),
    Row("null device", linked("log.csv", "/dev/null"),
        "log.csv: the file is empty"),
    Row("link to nowhere", linked("log.csv", "nowhere"),
        "log.csv: cannot be opened: No such file or directory"),
    Row("link to itself", linked("log.csv", "log.csv"),
        "log.csv: cannot be opened: Too many levels of symbolic links"),
    Row("file as folder", nothing,
        "log.csv/x: cannot be opened: Not a directory", "calibrate --robot=robot.yaml --log=log.csv/x"),
    Row("nothing on standard input", nothing,
        "/dev/stdin: the file is empty", "calibrate --robot=robot.yaml --log=/dev/stdin"),
    Row("binary", written("log.csv", bytes(range(256)) * 40),
        "log.csv: row 1: a NUL byte: the file is binary or UTF-16, or was being written "
        "when the power went"),
    Row("PNG", written("log.csv", b"\x89PNG\r\n\x1a\n" + bytes(100)),
        "log.csv: row 3: a NUL byte: the file is binary or UTF-16, or was being written "
        "when the power went"),
    Row("HTML", written("log.csv", "<!DOCTYPE html>\n<html><body>404</body></html>\n"),
        "log.csv: row 1: expected several columns separated by , ; or TAB, found '<!DOCTYPE "
        "html>'"),
    Row("JSON", written("log.csv", '{"t": [0, 1], "q1": [0, 1]}\n'), JSON),
    Row("JSON over many lines", written("log.csv", '{\n  "t": [0, 1],\n  "q1": [0, 1]\n}\n'), JSON),
    Row("records in JSON", written("log.csv", '[{"t": 0, "q1": 1}, {"t": 1, "q1": 1}]\n'), JSON),
    Row("JSON packed by gzip", written("log.csv", compressed('{"t": [0, 1]}\n')), JSON),
    Row("a single NumPy array", written("log.csv", b"\x93NUMPY\1\0" + bytes(118)),
        "log.csv: is a single NumPy array, whose columns have no names: save all arrays by "
        "name with numpy.savez"),
    Row("HDF5", written("log.csv", b"\x89HDF\r\n\x1a\n" + bytes(100)),
        "log.csv: is an HDF5 file, of which MATLAB's alone are read: open it with h5py and "
        "save its arrays by name with numpy.savez"),
    Row("Feather", written("log.csv", b"ARROW1\0\0" + bytes(100)),
        "log.csv: is an Arrow (Feather) file: read it with pandas.read_feather and write it "
        "with to_csv"),
    Row("ULog", written("log.csv", b"ULog\x01\x12\x35\x01" + bytes(8)),
        "log.csv: is a ULog of PX4: `ulog2csv` makes CSV of its topics"),
    Row("packed by xz", written("log.csv", b"\xfd7zXZ\0" + bytes(40)),
        "log.csv: is packed by xz: unpack it, or pack it with gzip"),
    Row("packed by bzip2", written("log.csv", bz2.compress(LOG.encode())),
        "log.csv: is packed by bzip2: unpack it, or pack it with gzip"),
    Row("packed by 7-Zip", written("log.csv", b"7z\xbc\xaf\x27\x1c" + bytes(40)),
        "log.csv: is packed by 7-Zip: unpack it, or pack it with gzip"),
    Row("workbook of Excel", written("log.csv", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(504)),
        "log.csv: is a workbook of Excel: save its sheet as CSV (UTF-8)"),
    Row("ROS 1 bag", written("log.csv", b"#ROSBAG V2.0\nE\0\0\0"),
        "log.csv: is a bag of ROS 1: `python3 -m armcal.convert log.csv FOLDER` makes one "
        "of ROS 2"),
    Row("Parquet", written("log.csv", b"PAR1\x15\x04\0\0"),
        "log.csv: is a Parquet file: `python3 -m armcal.convert log.csv log.npz` makes an "
        ".npz"),
    Row("ROS 1 topic as text", written("log.csv", "%time,field.position0\n1,2\n"),
        "log.csv: row 1: no time column: expected t, time, timestamp or __time; not "
        "recognised: '%time', 'field.position0'"),
    Row("packed by zstd", written("log.csv", b"\x28\xb5\x2f\xfd\x04\x00\x01\x00\x00"),
        "log.csv: is packed by zstd as a whole: unpack it with unzstd"),

    # Text, but not as it should be.
    Row("UTF-16", edited("log.csv", lambda x: x.decode().encode("utf-16")),
        "log.csv: the text is UTF-16; save it as UTF-8"),
    Row("UTF-16 without mark", edited("log.csv", lambda x: x.decode().encode("utf-16-le")),
        "log.csv: row 1: a NUL byte: the file is binary or UTF-16, or was being written "
        "when the power went"),
    Row("NUL bytes at the end", padded("log.csv", 2000),
        "log.csv: row 33: a NUL byte: the file is binary or UTF-16, or was being written "
        "when the power went"),
    Row("lines end in CR alone", edited("log.csv", lambda x: x.replace(b"\n", b"\r")),
        "log.csv: row 1: the lines end in CR alone; save the file with LF or CRLF"),
    Row("line without end", written("log.csv", HEADER + "\n" + "1" * 1100000),
        "log.csv: row 2: the line is longer than 1048576 bytes; this is not a log in CSV"),
    Row("sparse 64 GB", padded("log.csv", 1 << 36),
        "log.csv: row 33: a NUL byte: the file is binary or UTF-16, or was being written "
        "when the power went"),
    Row("no header", edited("log.csv", lambda x: x.partition(b"\n")[2]),
        "log.csv: row 1: expected a header that names the columns, as in t,q1,tau1"),
    Row("one column", edited("log.csv", lambda x: x.replace(b",", b"|")),
        "log.csv: row 1: expected several columns separated by , ; or TAB, found 't|q1|q2|"
        "tau1|tau2'"),
    Row("400000 columns", headed(HEADER + ",x" * 400000),
        "log.csv: row 2: found '5 fields': expected 400005 as in the header"),
    Row("header with control characters", headed("t,q1,q\x1b[31m2,tau1,tau2"),
        "log.csv: row 1: missing q2 or joint2/position; the robot has 2 joints, the log "
        "holds q1; not recognised: 'q [31m2'"),
    Row("header not UTF-8", edited("log.csv", lambda x: x.replace(b"tau2", b"tau\xff")),
        "log.csv: row 1: missing tau2 or joint2/effort; the robot has 2 joints, the log "
        "holds tau1; not recognised: 'tau�'"),

    # Columns.
    Row("no time", headed("x,q1,q2,tau1,tau2"),
        "log.csv: row 1: no time column: expected t, time, timestamp or __time; not "
        "recognised: 'x'"),
    Row("two times", headed("t,q1,q2,tau1,time"),
        "log.csv: row 1: two time columns, 't' and 'time'; rename one"),
    Row("torque missing", headed("t,q1,q2,tau1,other"),
        "log.csv: row 1: missing tau2 or joint2/effort; the robot has 2 joints, the log "
        "holds tau1; not recognised: 'other'"),
    Row("no torque", headed("t,q1,q2,a,b"),
        "log.csv: row 1: no torque: missing tau1 or joint1/effort, tau2 or joint2/effort; "
        "or currents (i1 or joint1/current, ..) or voltages (u1, ..) with "
        "--torque_constants; not recognised: 'a', 'b'"),
    Row("commands without a controller", headed("t,q1,q2,qref1,qref2"),
        "log.csv: row 1: no torque: missing tau1 or joint1/effort, tau2 or joint2/effort; "
        "or currents (i1 or joint1/current, ..) or voltages (u1, ..) with "
        "--torque_constants; or --controller, under which calibrate and verify simulate how the log's commands (qref) are "
        "followed"),
    Row("position missing", headed("t,q1,x,tau1,tau2"),
        "log.csv: row 1: missing q2 or joint2/position; the robot has 2 joints, the log "
        "holds q1; not recognised: 'x'"),
    Row("position twice", headed("t,q1,q1,q2,tau1"),
        "log.csv: row 1: two columns for the position of joint joint1, 'q1' and 'q1'; "
        "rename one"),
    Row("joint twice", headed("t,q1,joint1/position,q2,tau1"),
        "log.csv: row 1: two columns for the position of joint joint1, 'q1' and "
        "'joint1/position'; rename one"),
    Row("too many joints", headed("t,q1,q2,q3,tau1"),
        "log.csv: row 1: wrong number of joints: the robot has 2 joints, the log holds "
        "q1..q3"),
    Row("joints from 0", headed("t,q0,q1,q2,tau1"),
        "log.csv: row 1: joints are numbered from 1; the robot has 2 joints, the log holds "
        "q0..q2"),
    Row("joint number of 11 digits", headed("t,q1,q99999999999,tau1,tau2"),
        "log.csv: row 1: missing q2 or joint2/position; the robot has 2 joints, the log "
        "holds q1; not recognised: 'q99999999999'"),
    Row("unit of position", headed("t,q1,q2 [turns],tau1,tau2"),
        "log.csv: row 1: column 'q2 [turns]': expected a unit of rad, deg, m, mm"),
    Row("unit of torque", headed("t,q1,q2,tau1 [oz in],tau2"),
        "log.csv: row 1: column 'tau1 [oz in]': expected a unit of Nm, N m, N, mNm, kNm"),
    Row("unit of time", headed("t [min],q1,q2,tau1,tau2"),
        "log.csv: row 1: column 't [min]': expected a unit of s, ms, us or ns"),
    Row("currents without constants", headed("t,q1,q2,i1,i2"),
        "log.csv: the torque comes from currents (i1 to i2), its scale is not observable from them "
        "alone: expected --torque_constants=K1,.. in N m/A, one per joint, or "
        "--payload_mass and --payload_log to estimate them"),

    # Cells.
    Row("nan", with_row(5, "1.13,0.1,nan,0.1,0.1"),
        "log.csv: row 5, column q2: found 'nan': expected a finite number"),
    Row("inf", with_row(5, "1.13,0.1,0.1,-inf,0.1"),
        "log.csv: row 5, column tau1: found '-inf': expected a finite number"),
    Row("NaN in time", with_row(5, "nan,0.1,0.1,0.1,0.1"),
        "log.csv: row 5, column t: found 'nan': expected a finite number"),
    Row("text", with_row(5, "1.13,0.1,0.1,off,0.1"),
        "log.csv: row 5, column tau1: found 'off': expected a finite number"),
    Row("empty cell", with_row(5, "1.13,0.1,,0.1,0.1"),
        "log.csv: row 5, column q2: the field is empty, expected a number"),
    Row("unit in a cell", with_row(5, "1.13,0.1rad,0.1,0.1,0.1"),
        "log.csv: row 5, column q1: found '0.1rad': expected a finite number"),
    Row("hexadecimal", with_row(5, "1.13,0x1p3,0.1,0.1,0.1"),
        "log.csv: row 5, column q1: found '0x1p3': expected a finite number"),
    Row("too large", with_row(5, "1.13,1e999,0.1,0.1,0.1"),
        "log.csv: row 5, column q1: found '1e999': expected a finite number"),
    Row("quoted", with_row(5, '1.13,"0.1",0.1,0.1,0.1'),
        'log.csv: row 5, column q1: found \'"0.1"\': expected a finite number'),
    Row("decimal comma", edited("log.csv", lambda x: x.replace(b",", b";").replace(b".", b",")),
        "log.csv: row 2, column q1: found '0,1': expected a finite number with a decimal "
        "point, not a comma"),
    Row("Arabic digits", with_row(5, "1.13,٣,0.1,0.1,0.1"),
        "log.csv: row 5, column q1: found '٣': expected a finite number"),
    Row("huge digits", with_row(5, "1.13," + "9" * 100000 + ",0.1,0.1,0.1"),
        "log.csv: row 5, column q1: found "
        "'99999999999999999999999999999999999999999999999999999999999999999999999999999999...': "
        "expected a finite number"),
    Row("date as time", with_row(2, "2026-11-21T10:30:00,0.1,0.1,0.1,0.1"),
        "log.csv: row 2, column t: found '2026-11-21T10:30:00': expected a finite number"),

    # Rows.
    Row("short row", with_row(5, "1.13,0.1,0.1,0.1"),
        "log.csv: row 5: found '4 fields': expected 5 as in the header"),
    Row("long row", with_row(5, "1.13,0.1,0.1,0.1,0.1,0.1"),
        "log.csv: row 5: found '6 fields': expected 5 as in the header"),
    Row("cut in a row", cut("log.csv", -7),
        "log.csv: row 32: found '4 fields': expected 5 as in the header; the file ends "
        "inside this row, delete it"),
    Row("empty row within", with_row(5, ""),
        "log.csv: row 5: the row is empty, and more rows follow"),
    Row("header again", with_row(5, HEADER),
        "log.csv: row 5, column q1: found 'q1': expected a finite number"),
    Row("a comment", with_row(5, "# paused"),
        "log.csv: row 5: found '1 field': expected 5 as in the header"),
    Row("time backwards", with_row(5, "1.05,0.1,0.1,0.1,0.1"),
        "log.csv: row 5, column t: found '1.05': time runs backwards, the row before has "
        "1.12"),
    Row("time stands still", edited("log.csv", lambda x: b"\n".join(
        [line if k == 0 else b"1" + line[line.index(b","):]
         for k, line in enumerate(x.splitlines())]) + b"\n"),
        "log.csv: found '1 samples': expected at least 3 samples with different times in "
        "the log (--crop keeps a part of it)"),
    Row("milliseconds as seconds", written("log.csv", epoch(3)),
        "log.csv: row 2, column t: found '1700000000000': expected seconds; if these are "
        "ms, call the column 't [ms]'"),
    Row("microseconds as seconds", written("log.csv", epoch(6)),
        "log.csv: row 2, column t: found '1700000000000000': expected seconds; if these are "
        "us, call the column 't [us]'"),
    Row("nanoseconds as seconds", written("log.csv", epoch(9)),
        "log.csv: row 2, column t: found '1700000000000000000': expected seconds; if these "
        "are ns, call the column 't [ns]'"),
    Row("one sample", written("log.csv", "\n".join(LOG.splitlines()[:2]) + "\n"),
        "log.csv: found '1 samples': expected at least 3 samples with different times in "
        "the log (--crop keeps a part of it)"),
    Row("two samples", written("log.csv", "\n".join(LOG.splitlines()[:3]) + "\n"),
        "log.csv: found '2 samples': expected at least 3 samples with different times in "
        "the log (--crop keeps a part of it)"),

    # Compressed.
    Row("gzip cut", both(written("log.csv", compressed(LOG)), cut("log.csv", -9)),
        "log.csv: row 33: the gzip stream ends early, the file is truncated; copy or record "
        "it again"),
    Row("gzip of nothing", written("log.csv", compressed("")),
        "log.csv: the file is empty"),
    Row("gzip header alone", written("log.csv", b"\x1f\x8b"),
        "log.csv: row 1: the gzip stream ends early, the file is truncated; copy or record "
        "it again"),
    Row("gzip damaged", both(written("log.csv", compressed(LOG)), edited(
        "log.csv", lambda x: x[:100] + bytes([x[100] ^ 64]) + x[101:])),
        "log.csv: row 7: found '25 fields': expected 5 as in the header"),
    Row("gzip with wrong checksum", both(written("log.csv", compressed(LOG)), edited(
        "log.csv", lambda x: x[:-8] + bytes([x[-8] ^ 1]) + x[-7:])),
        "log.csv: row 33: the gzip stream is damaged; copy or record the file again"),
    Row("bytes after gzip", both(written("log.csv", compressed(LOG)), edited(
        "log.csv", lambda x: x + b"more")),
        "log.csv: row 33: bytes that are not gzip follow the gzip stream; cut them off or "
        "unpack the file"),
    Row("gzip in gzip", written("log.csv", lambda: compressed(compressed(LOG)())()),
        "log.csv: row 1: a NUL byte: the file is binary or UTF-16, or was being written "
        "when the power went"),
    Row("gzip bomb of zeros", written("log.csv", compressed("\0" * (1 << 20), 500)),
        "log.csv: row 1: a NUL byte: the file is binary or UTF-16, or was being written "
        "when the power went"),
    Row("gzip bomb in one line", written("log.csv", compressed("1" * (1 << 20), 500)),
        "log.csv: row 1: the line is longer than 1048576 bytes; this is not a log in CSV"),
    Row("gzip bomb of empty lines", written("log.csv", compressed(HEADER + "\n" + "\n" * (1 << 20), 300)),
        "log.csv: row 2: the row is empty, and more rows follow"),

    # Held out, and what flags say of the log.
    Row("held out cut", both(written("B.csv", compressed(LOG)), cut("B.csv", -9)),
        "B.csv: row 33: the gzip stream ends early, the file is truncated; copy or record "
        "it again",
        "calibrate --robot=robot.yaml --log=log.csv --validate=B.csv --out=out"),
    Row("held out beyond squares", written("B.csv", "\n".join(
        [HEADER] + [",".join(f"{x:g}" for x in [*s[:-1], 1e266]) for s in SAMPLES])),
        "B.csv: the torque in the held-out logs overflows; expected torques in N m, forces in N",
        "calibrate --robot=robot.yaml --log=log.csv --validate=B.csv --out=out"),
    Row("held out missing", nothing,
        "absent.csv: cannot be opened: No such file or directory", "calibrate --robot=robot.yaml --log=log.csv --validate=absent.csv --out=out"),
    Row("nothing left of it", nothing,
        "log.csv: found '0 samples': expected at least 3 samples with different times in "
        "the log (--crop keeps a part of it)", "calibrate --robot=robot.yaml --log=log.csv --crop=10:11 --out=out"),
    Row("bandwidth above half the rate", nothing,
        "--bandwidth: found '1000': expected 0, or less than half the sample rate, 50 Hz", "calibrate --robot=robot.yaml --log=log.csv --bandwidth=1000 --out=out"),
    Row("torque kind that is not there", nothing,
        "log.csv: the torque comes from currents (tau1 to tau2), its scale is not observable from them "
        "alone: expected --torque_constants=K1,.. in N m/A, one per joint, or "
        "--payload_mass and --payload_log to estimate them", "calibrate --robot=robot.yaml --log=log.csv --torque_kind=current --out=out"),
    Row("too many constants", nothing,
        "--torque_constants: found '1 2 3': expected one value per joint, the robot has 2", "calibrate --robot=robot.yaml --log=log.csv --torque_constants=1,2,3 --out=out"),
    Row("intervals beyond the log", nothing,
        "log.csv: --intervals: 1 of 1 intervals cannot be used; expected each to lie within "
        "the log, clear of gaps and standstill", "calibrate --robot=robot.yaml --log=log.csv --identification=integral --intervals=0:9 --out=out"),
    Row("result into a file", written("blocked", ""),
        "blocked/out: --out: cannot be written: Not a directory", "calibrate --robot=robot.yaml --log=log.csv --out=blocked/out"),
]),

    # What is wrong where nobody looks does no harm.
    Group("csv with more columns", "calibrate --robot=robot.yaml --log=log.csv --out=out",
            {"robot.yaml": ARM, "log.csv": LOG.replace("\n", ",nan,off\n").replace(
                "tau2,nan,off", "tau2,a,b")}, [])]
