"""Logs as arrays: NumPy's .npz, MATLAB's .mat of v4, v5 and v7.3."""

import io
import struct
import zipfile
import zlib

from inputs import ARM, SAMPLES, Group, Row, both, cut, edited, written

COLUMNS = dict(zip(("t", "q1", "q2", "tau1", "tau2"), map(list, zip(*SAMPLES))))


def npy(values, descr="'<f8'", shape=None, order="False"):
    """An array in NumPy's format 1.0; `values` are numbers or bytes."""
    shape = f"({len(values)},)" if shape is None else shape
    header = f"{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}\n"
    data = values if isinstance(values, bytes) else struct.pack(f"<{len(values)}d", *values)
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header.encode() + data


def npz(method=zipfile.ZIP_DEFLATED, **arrays):
    """The good log as .npz, but for the bytes of `arrays`; None: left out."""
    def make():
        entries = {name: npy(values) for name, values in COLUMNS.items()} | arrays
        file = io.BytesIO()
        with zipfile.ZipFile(file, "w", method) as archive:
            for name, data in entries.items():
                if data is not None:
                    archive.writestr(f"{name}.npy", data)
        return file.getvalue()
    return make


def log(**arrays):
    return written("log.npz", npz(**arrays))


def stored(**arrays):
    """Not packed, so that its bytes are found in the file."""
    return written("log.npz", npz(zipfile.ZIP_STORED, **arrays))


def directory_field(name, offset, form, value):
    """A number in the directory's entry of an array."""
    def edit(data):
        data = bytearray(data)
        at = data.index(name.encode() + b".npy", data.index(b"PK\1\2")) - 46
        struct.pack_into(form, data, at + offset, value)
        return bytes(data)
    return edited("log.npz", edit)


def overlapping(count, size):
    """Many entries that are the same bytes of the file, which unpack to `size`."""
    def make():
        pack = zlib.compressobj(9, wbits=-15)
        head, block = npy(b"", shape=f"({size // 8},)"), bytes(1 << 20)
        packed, crc = pack.compress(head), zlib.crc32(head)
        for _ in range(size >> 20):
            packed += pack.compress(block)
            crc = zlib.crc32(block, crc)
        packed += pack.flush()
        sizes = (crc, len(packed), len(head) + size)
        first = struct.pack("<4s5H3I2H", b"PK\3\4", 20, 0, 8, 0, 0, *sizes, 5, 0) + b"t.npy" + packed
        entries = b""
        for k in range(count):
            name = b"t.npy" if k == 0 else b"x%05d.npy" % k
            entries += struct.pack("<4s6H3I5H2I", b"PK\1\2", 20, 20, 0, 8, 0, 0, *sizes,
                                   len(name), 0, 0, 0, 0, 0, 0) + name
        return first + entries + struct.pack("<4s4H2IH", b"PK\5\6", 0, 0, count, count,
                                             len(entries), len(first), 0)
    return make


PICKLE = b"cos\nsystem\n(S'touch owned'\ntR."  # would run a command

NPZ = Group("npz", "calibrate --robot=robot.yaml --log=log.npz --out=out",
            {"robot.yaml": ARM, "log.npz": npz()}, [
    Row("first bytes alone", written("log.npz", b"PK\3\4"),
        "log.npz: is a zip archive without its directory: it was cut off"),
    Row("cut", cut("log.npz", 600),
        "log.npz: is a zip archive without its directory: it was cut off"),
    Row("cut before the end", cut("log.npz", -1),
        "log.npz: is a zip archive without its directory: it was cut off"),
    Row("array of objects", log(tau1=npy(PICKLE, "'|O'", "(31,)")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of Python objects, which are never unpickled)"),
    Row("times of objects", log(t=npy(PICKLE, "'|O'", "(31,)")),
        "log.npz: row 1: no time column: expected t, time, timestamp or __time; not used: t "
        "(of Python objects, which are never unpickled)"),
    Row("structured array", log(tau1=npy(bytes(31 * 16), "[('a', '<f8'), ('b', '<f8')]")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of type [('a', '<f8'), ('b', '<f8')], not f4, f8 or an "
        "integer)"),
    Row("big-endian", log(tau1=npy(bytes(8 * 31), "'>f8'", "(31,)")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of type '>f8', not f4, f8 or an integer)"),
    Row("half precision", log(tau1=npy(bytes(2 * 31), "'<f2'", "(31,)")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of type '<f2', not f4, f8 or an integer)"),
    Row("complex", log(tau1=npy(bytes(16 * 31), "'<c16'", "(31,)")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of type '<c16', not f4, f8 or an integer)"),
    Row("texts as torques", log(tau1=npy(bytes(8 * 31), "'<U2'", "(31,)")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of texts)"),
    Row("three dimensions", log(tau1=npy(COLUMNS["tau1"], shape="(31, 1, 1)")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of 3 dimensions)"),
    Row("a number", log(tau1=npy([1.0], shape="()")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of 0 dimensions)"),
    Row("shape larger than the bytes", log(tau1=npy(COLUMNS["tau1"], shape="(310000000000,)")),
        "log.npz: array tau1: is cut off"),
    Row("shape whose product overflows", log(tau1=npy(
        COLUMNS["tau1"], shape="(4294967296, 4294967296)")),
        "log.npz: array tau1: is cut off"),
    Row("shape beyond 64 bits", log(tau1=npy(
        COLUMNS["tau1"], shape="(99999999999999999999,)")),
        "log.npz: array tau1: has a damaged header"),
    Row("shape of no columns", log(q1=npy(b"", shape="(9000000000000000000, 0)")),
        "log.npz: row 1: missing q1 or joint1/position; the robot has 2 joints, the log "
        "holds q2; not used: q1 (of 9000000000000000000 rows, not 31)"),
    Row("negative shape", log(tau1=npy(COLUMNS["tau1"], shape="(-31,)")),
        "log.npz: array tau1: has a header that is not NumPy's"),
    Row("header that is code", log(tau1=npy(COLUMNS["tau1"], "__import__('os').system('touch owned')")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of type __import__('os').system('touch owned'), not "
        "f4, f8 or an integer)"),
    Row("header of 65000 characters", log(tau1=npy(COLUMNS["tau1"], "'" + "<f8" * 21000 + "'")),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of type "
        "'<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<f8<..., "
        "not f4, f8 or an integer)"),
    Row("header longer than the file", log(tau1=b"\x93NUMPY\2\0" + b"\xff\xff\xff\x7f{'descr'"),
        "log.npz: array tau1: has a damaged header"),
    Row("not an array", log(tau1=b"1 2 3 4 5 6 7 8 9"),
        "log.npz: array tau1: is not in NumPy's .npy format"),
    Row("empty array", log(tau1=npy([])),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of 0 rows, not 31)"),
    Row("no times", log(t=None),
        "log.npz: row 1: no time column: expected t, time, timestamp or __time"),
    Row("no rows", log(t=npy([]), q1=npy([]), q2=npy([]), tau1=npy([]), tau2=npy([])),
        "log.npz: found 't, q1, q2, tau1, tau2': has no array of times: expected t, time or "
        "timestamp"),
    Row("another length", log(tau1=npy(COLUMNS["tau1"][:-1])),
        "log.npz: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (of 30 rows, not 31)"),
    Row("nan", log(tau1=npy([float("nan")] + COLUMNS["tau1"][1:])),
        "log.npz: row 2, column tau1: found 'nan': expected a finite number"),
    Row("times backwards", log(t=npy(COLUMNS["t"][::-1])),
        "log.npz: row 3, column t: found '1.3900000000000001': time runs backwards, the row "
        "before has 1.4"),
    Row("path outside", log(**{"../../../etc/passwd": npy([1.0]), "t": None}),
        "log.npz: row 1: no time column: expected t, time, timestamp or __time; not used: "
        "../../../etc/passwd (of 1 rows, not 31)"),
    Row("name of control characters", log(**{"x\x1b[31m\n": b"?"}),
        "log.npz: array x [31m : is not in NumPy's .npy format"),
    Row("byte changed", both(stored(), edited("log.npz", lambda x: x[:200] + b"?" + x[201:])),
        "log.npz: is damaged in t.npy: its checksum is wrong"),
    Row("method unknown", directory_field("q1", 10, "<H", 12),
        "log.npz: packs q1.npy by method 12; expected stored or deflated, as numpy.savez "
        "writes"),
    Row("encrypted", directory_field("q1", 8, "<H", 1),
        "log.npz: is encrypted"),
    Row("size of 4 GB", directory_field("q1", 24, "<I", 0xfffffff0),
        "log.npz: unpacks to more than 64 MiB and 200 times its size: expected a log, which "
        "does not pack that much"),
    Row("smaller than it says", directory_field("q1", 24, "<I", 3000),
        "log.npz: is damaged in q1.npy"),
    Row("place beyond the file", directory_field("q1", 42, "<I", 0x7fffffff),
        "log.npz: is a damaged zip archive: it ends too early"),
    Row("directory beyond the file", edited("log.npz", lambda x: x[:-6] + b"\xff\xff\xff\x7f\0\0"),
        "log.npz: is a damaged zip archive: it ends too early"),
    Row("more entries than there are", edited("log.npz", lambda x: x[:-12] + b"\xff\x7f" + x[-10:]),
        "log.npz: is a damaged zip archive"),
    Row("zip64 beyond the file", edited("log.npz", lambda x: x + struct.pack(
        "<4sIQI", b"PK\6\7", 0, 1 << 62, 1) + struct.pack("<4s4H2IH", b"PK\5\6", 0, 0, 65535, 65535,
                                                          0xffffffff, 0xffffffff, 0)),
        "log.npz: is a damaged zip archive: it ends too early"),
    Row("bomb of 1 GB", written("log.npz", overlapping(1, 1 << 30)),
        "log.npz: unpacks to more than 64 MiB and 200 times its size: expected a log, which "
        "does not pack that much"),
    Row("bomb of 1000 arrays on one", written("log.npz", overlapping(1000, 1 << 24)),
        "log.npz: unpacks to more than 64 MiB and 200 times its size: expected a log, which "
        "does not pack that much"),
])


def v4(type_, rows, columns, imaginary, name, data):
    return struct.pack("<5I", type_, rows, columns, imaginary, len(name) + 1) + name + b"\0" + data


def element(type_, data):
    return struct.pack("<2I", type_, len(data)) + data + bytes(-len(data) % 8)


def matrix(name, rows, columns, data, class_=6, type_=9):
    """A matrix of v5; class 6: of doubles."""
    return element(14, element(6, struct.pack("<2I", class_, 0)) +
                   element(5, struct.pack("<2i", rows, columns)) +
                   element(1, name) + (data if class_ == 1 else element(type_, data)))


def nested_cells(depth):
    """Built from the inside out in one pass, as each holds all that follow."""
    def make():
        inner = matrix(b"", 1, 1, bytes(8))
        heads, size = [], len(inner)
        for _ in range(depth):
            head = (element(6, struct.pack("<2I", 1, 0)) + element(5, struct.pack("<2i", 1, 1)) +
                    element(1, b""))
            heads.append(struct.pack("<2I", 14, len(head) + size) + head)
            size += len(head) + 8
        return V5_HEAD + b"".join(reversed(heads)) + inner
    return make


V5_HEAD = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM"


def v5(**changed):
    arrays = {name.encode(): struct.pack("<31d", *values) for name, values in COLUMNS.items()}
    return V5_HEAD + b"".join(
        changed.get(name.decode()) or matrix(name, 31, 1, data) for name, data in arrays.items())


def packed_v5(data, zeros=0):
    """A compressed element of `data` and as many zero bytes."""
    pack = zlib.compressobj(9)
    packed = pack.compress(data) + b"".join(
        pack.compress(bytes(1 << 20)) for _ in range(zeros >> 20)) + pack.flush()
    return V5_HEAD + struct.pack("<2I", 15, len(packed)) + packed


def head_of_matrix(rows):
    """Of v5, named t, up to its numbers."""
    whole = matrix(b"t", rows, 1, b"")
    return (struct.pack("<2I", 14, len(whole) - 8 + 8 * rows) + whole[8:-4] +
            struct.pack("<I", 8 * rows))


MAT = Group("mat", "calibrate --robot=robot.yaml --log=log.mat --out=out",
            {"robot.yaml": ARM, "log.mat": v5, "v4.mat": "@v4.mat", "v73.mat": "@v73.mat"}, [
    Row("header alone", cut("log.mat", 128),
        "log.mat: is a MAT-file in which no variable can be read: it is empty, damaged or "
        "cut off"),
    Row("cut in the header", cut("log.mat", 100),
        "log.mat: is damaged: expected a whole MAT-file"),
    Row("cut", cut("log.mat", 900),
        "log.mat: is cut off: expected a whole MAT-file"),
    Row("element of unknown type", edited("log.mat", lambda x: x[:128] + b"\x63" + x[129:]),
        "log.mat: is damaged: expected a whole MAT-file"),
    Row("element beyond the file", edited("log.mat", lambda x: x[:132] + b"\xff\xff\xff\x7f" + x[136:]),
        "log.mat: is cut off: expected a whole MAT-file"),
    Row("dimensions beyond the file", written("log.mat", v5(
        tau1=matrix(b"tau1", 0x7fffffff, 0x7fffffff, bytes(8)))),
        "log.mat: variable tau1: found '8 bytes': expected 4611686014132420609 numbers, as "
        "its dimensions say"),
    Row("negative dimensions", written("log.mat", v5(tau1=matrix(b"tau1", -31, 1, bytes(248)))),
        "log.mat: variable tau1: found '248 bytes': expected 4294967265 numbers, as its "
        "dimensions say"),
    Row("more elements than bytes", written("log.mat", v5(tau1=matrix(b"tau1", 31, 1, bytes(80)))),
        "log.mat: variable tau1: found '80 bytes': expected 31 numbers, as its dimensions "
        "say"),
    Row("no name", written("log.mat", v5(tau1=matrix(b"", 31, 1, bytes(248)))),
        "log.mat: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2"),
    Row("cells instead of numbers", written("log.mat", v5(
        tau1=matrix(b"tau1", 1, 1, matrix(b"", 1, 1, bytes(8)), 1))),
        "log.mat: row 1: missing tau1 or joint1/effort; the robot has 2 joints, the log "
        "holds tau2; not used: tau1 (not of real numbers in rows and columns)"),
    Row("1000 nested cells", written("log.mat", nested_cells(1000)),
        "log.mat: has no array of times: expected t, time or timestamp"),
    Row("20000 nested cells", written("log.mat", nested_cells(20000)),
        "log.mat: has no array of times: expected t, time or timestamp"),
    Row("nan", written("log.mat", v5(tau1=matrix(b"tau1", 31, 1, b"\xff" * 248))),
        "log.mat: row 2, column tau1: found '-nan': expected a finite number"),
    Row("no times", edited("log.mat", lambda x: x.replace(b"t\0\0\0", b"s\0\0\0")),
        "log.mat: row 1: no time column: expected t, time, timestamp or __time; not "
        "recognised: 's'"),
    Row("packed and damaged", written("log.mat", lambda: packed_v5(matrix(b"t", 31, 1, bytes(248)))[:-4] + b"1234"),
        "log.mat: is damaged: expected a whole MAT-file"),
    Row("packed bomb", written("log.mat", lambda: packed_v5(
        head_of_matrix(1 << 25), 1 << 28)),
        "log.mat: variable t: is of more than 64 MiB and 200 times the file's size: "
        "expected a log, which does not pack that much"),
    Row("packed, dimensions beyond it", written("log.mat", lambda: packed_v5(
        matrix(b"t", 1 << 28, 1, bytes(100)))),
        "log.mat: variable t: found '100 bytes': expected 268435456 numbers, as its "
        "dimensions say"),
    Row("v4 cut", both(cut("v4.mat", 700)),
        "v4.mat: is cut off: expected a whole MAT-file", "calibrate --robot=robot.yaml --log=v4.mat"),
    Row("v4 dimensions beyond the file", written("log.mat", v4(0, 1 << 31, 1 << 31, 0, b"t", b"")),
        "log.mat: is cut off: expected a whole MAT-file"),
    Row("v4 name beyond the file", written("log.mat", struct.pack("<5I", 0, 1, 1, 0, 60) + b"t"),
        "log.mat: is cut off: expected a whole MAT-file"),
    Row("v4 sparse", written("log.mat", v4(2, 3, 3, 0, b"t", bytes(72))),
        "log.mat: found 't': has no array of times: expected t, time or timestamp; not "
        "used: t (damaged, or of a class that is not read)"),
    Row("v4 text", written("log.mat", v4(51, 1, 3, 0, b"t", b"abc")),
        "log.mat: found 't': has no array of times: expected t, time or timestamp; not "
        "used: t (not of real numbers in rows and columns)"),
    Row("v7.3 cut", cut("v73.mat", 5000),
        "v73.mat: is a MAT-file in which no variable can be read: it is empty, damaged or "
        "cut off", "calibrate --robot=robot.yaml --log=v73.mat"),
    Row("v7.3 header alone", cut("v73.mat", 512),
        "v73.mat: is a MAT-file in which no variable can be read: it is empty, damaged or "
        "cut off", "calibrate --robot=robot.yaml --log=v73.mat"),
    Row("v7.3 damaged", edited("v73.mat", lambda x: x[:600] + b"\xff" * 200 + x[800:]),
        "v73.mat: is a MAT-file in which no variable can be read: it is empty, damaged or "
        "cut off",
        "calibrate --robot=robot.yaml --log=v73.mat"),
    Row("v7.3 without its numbers", edited("v73.mat", lambda x: x[:1500] + bytes(len(x) - 1500)),
        "v73.mat: is a damaged MAT-file, or cut off",
        "calibrate --robot=robot.yaml --log=v73.mat"),
])
GROUPS = [NPZ, MAT]
