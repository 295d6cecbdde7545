"""Logs as bags of ROS 2: SQLite (.db3), MCAP, folders of rosbag2."""

import os
import sqlite3
import struct
import tempfile

from inputs import ARM, Group, Row, a_folder, both, cut, edited, linked, padded, removed, replaced, written

STATE = "sensor_msgs/msg/JointState"


def text(value):
    data = value.encode() if isinstance(value, str) else value
    return struct.pack("<I", len(data)) + data


class Cdr(bytearray):
    """A message as DDS encodes it, little-endian."""

    def __init__(self):
        super().__init__(b"\0\1\0\0")

    def add(self, form, *values):
        size = struct.calcsize("<" + form)
        self.extend(bytes(-(len(self) - 4) % size))
        for value in values:
            self.extend(struct.pack("<" + form, value))
        return self

    def text(self, value):
        self.add("I", len(value) + 1)
        self.extend(value.encode() + b"\0")
        return self

    def numbers(self, values):
        self.add("I", len(values))
        return self.add("d", *values) if values else self


def state(k, names=("joint1", "joint2"), position=None, nanoseconds=None):
    message = Cdr().add("i", 1).add("I", 10000000 * k if nanoseconds is None else nanoseconds)
    message.text("base").add("I", len(names))
    for name in names:
        message.text(name)
    q = (k / 40, (-1) ** k / 2) if position is None else position
    return bytes(message.numbers(q).numbers(()).numbers((2.0, 0.1 * k)))


STATES = [state(k) for k in range(40)]


def db3(states=STATES, topic=(1, "/joint_states", STATE, "cdr"), tables=(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)",
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)"),
        more=()):
    def make():
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "log.db3")
            base = sqlite3.connect(path)
            for sql in tables:
                base.execute(sql)
            if states and "TABLE topics(id" in tables[0]:
                base.execute("INSERT INTO topics VALUES (?, ?, ?, ?)", topic)
                base.executemany("INSERT INTO messages VALUES (?, ?, ?, ?)",
                                 [(k + 1, 1, 10**9 + k * 10**7, s) for k, s in enumerate(states)])
            for sql in more:
                base.execute(sql)
            base.commit()
            base.close()
            with open(path, "rb") as file:
                return file.read()
    return make


def bag(**arguments):
    return written("log.db3", db3(**arguments))


def one_state(message, k=3):
    """The bag whose message k + 1 is `message`."""
    return STATES[:k] + [message] + STATES[k + 1:]


def wrench(k, nanoseconds=None, values=(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)):
    message = Cdr().add("i", 1).add("I", 10000000 * k if nanoseconds is None else nanoseconds)
    return bytes(message.text("tool").add("d", *values))


def sensor_db3(messages):
    """A bag with a force-torque sensor's messages beside those of the joints."""
    return db3(more=["INSERT INTO topics VALUES (2, '/ft', 'geometry_msgs/msg/WrenchStamped', 'cdr')"] + [
        f"INSERT INTO messages VALUES ({1000 + k}, 2, {10**9 + k * 10**7}, x'{m.hex()}')"
        for k, m in enumerate(messages)])


def sensor(messages):
    return written("log.db3", sensor_db3(messages))


WRENCHES = [wrench(k) for k in range(40)]


def one_wrench(message, k=3):
    return sensor(WRENCHES[:k] + [message] + WRENCHES[k + 1:])


SENSOR = Group("sensor", "calibrate --robot=robot.yaml --log=log.db3 --topics=wrench:/ft --out=out",
               {"robot.yaml": ARM, "log.db3": sensor_db3(WRENCHES)}, [
    Row("no sensor", bag(), "log.db3: topic /ft: is not in the bag; the bag has /joint_states "
        "(sensor_msgs/msg/JointState of joint1, joint2)"),
    Row("no messages of it", sensor([]), "log.db3: topic /ft: has no messages"),
    Row("cut", one_wrench(wrench(3)[:60]),
        "log.db3: topic /ft, message 4: ends after 60 bytes, in the middle of a value; expected "
        "a message of geometry_msgs/msg/WrenchStamped"),
    Row("bytes too many", one_wrench(wrench(3) + bytes(16)),
        "log.db3: topic /ft, message 4: has 16 bytes too many; expected a message of "
        "geometry_msgs/msg/WrenchStamped"),
    Row("nanoseconds beyond a second", one_wrench(wrench(3, nanoseconds=1 << 31)),
        "log.db3: topic /ft, message 4: has 2147483648 ns in its stamp, expected less than a "
        "second; expected a message of geometry_msgs/msg/WrenchStamped"),
    Row("time backwards", one_wrench(wrench(3, nanoseconds=0)),
        "log.db3: topic /ft, message 4: found '1000000000 ns': time runs backwards, the message "
        "before has 1020000000 ns"),
    Row("nan", one_wrench(wrench(3, values=(1.0, 2.0, 3.0, 4.0, 5.0, float("nan")))),
        "log.db3: row 5, column tz: found 'nan': expected a finite number"),
    Row("stamps of another clock", sensor([wrench(0)[:4] + b"\0" * 4 + m[8:] for m in WRENCHES]),
        "log.db3: the messages that are to be joined are of different times; the bag has /ft "
        "(geometry_msgs/msg/WrenchStamped), /joint_states (sensor_msgs/msg/JointState of joint1, "
        "joint2)"),
])


DB3 = Group("db3", "calibrate --robot=robot.yaml --log=log.db3 --out=out",
            {"robot.yaml": ARM, "log.db3": db3()}, [
    Row("first bytes alone", written("log.db3", b"SQLite format 3\0"),
        "log.db3: SQLite says: file is not a database; expected a whole bag of ROS 2"),
    Row("cut", cut("log.db3", 6000),
        "log.db3: SQLite says: database disk image is malformed; expected a whole bag of "
        "ROS 2"),
    Row("pages overwritten", edited("log.db3", lambda x: x[:4096] + b"\xff" * (len(x) - 4096)),
        "log.db3: SQLite says: database disk image is malformed; expected a whole bag of "
        "ROS 2"),
    Row("schema overwritten", edited("log.db3", lambda x: x[:100] + b"\xff" * 3000 + x[3100:]),
        "log.db3: SQLite says: database disk image is malformed; expected a whole bag of "
        "ROS 2"),
    Row("page size 1", edited("log.db3", lambda x: x[:16] + b"\0\3" + x[18:]),
        "log.db3: SQLite says: file is not a database; expected a whole bag of ROS 2"),
    Row("no tables", bag(tables=("CREATE TABLE other(a)",)),
        "log.db3: is an SQLite data base, but not a bag of ROS 2: expected the tables "
        "topics and messages"),
    Row("other columns", bag(tables=(
        "CREATE TABLE topics(a, b, c, d)", "CREATE TABLE messages(a, b, c, d)")),
        "log.db3: SQLite says: no such column: id; expected a whole bag of ROS 2"),
    Row("views as tables", bag(tables=(
        "CREATE VIEW topics AS SELECT 1 AS id, '/j' AS name, 'x' AS type, 'cdr' AS serialization_format",
        "CREATE VIEW messages AS WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM r) "
        "SELECT n AS id, 1 AS topic_id, n AS timestamp, x'00' AS data FROM r")),
        "log.db3: is an SQLite data base, but not a bag of ROS 2: expected the tables "
        "topics and messages"),
    Row("computed message of 60 MB", bag(states=[], tables=(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)",
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, "
        "data BLOB AS (zeroblob(60000000)))"), more=(
        "INSERT INTO topics VALUES (1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr')",
        "INSERT INTO messages(topic_id, timestamp) VALUES (1, 1)")),
        "log.db3: topic /joint_states, message 1: has 59999968 bytes too many; expected a "
        "message of sensor_msgs/msg/JointState"),
    Row("no topics", bag(states=[]),
        "log.db3: no message gives the position of joint1, joint2; the bag has no topics"),
    Row("topic of another type", bag(topic=(1, "/joint_states", "std_msgs/msg/String", "cdr")),
        "log.db3: no message gives the position of joint1, joint2; the bag has "
        "/joint_states (std_msgs/msg/String)"),
    Row("topic of another encoding", bag(topic=(1, "/joint_states", STATE, "json")),
        "log.db3: topic /joint_states: found 'json': expected messages encoded as cdr, as "
        "in ROS 2"),
    Row("topic of control characters", bag(topic=(1, "/a\x1b[31m\n", STATE, "json")),
        "log.db3: topic /a [31m : found 'json': expected messages encoded as cdr, as in ROS "
        "2"),
    Row("empty message", bag(states=one_state(b"")),
        "log.db3: topic /joint_states, message 4: has 0 bytes; expected a message of "
        "sensor_msgs/msg/JointState"),
    Row("message NULL", bag(states=one_state(None)),
        "log.db3: topic /joint_states, message 4: has 0 bytes; expected a message of "
        "sensor_msgs/msg/JointState"),
    Row("message as text", bag(states=one_state("position: [0, 1]")),
        "log.db3: topic /joint_states, message 4: is not encoded as CDR (0 or 1), but as "
        "28783; expected a message of sensor_msgs/msg/JointState"),
    Row("message cut", bag(states=one_state(STATES[3][:60])),
        "log.db3: topic /joint_states, message 4: says that 2 numbers follow, and 0 bytes "
        "do; expected a message of sensor_msgs/msg/JointState"),
    Row("bytes too many", bag(states=one_state(STATES[3] + bytes(16))),
        "log.db3: topic /joint_states, message 4: has 16 bytes too many; expected a message "
        "of sensor_msgs/msg/JointState"),
    Row("4 billion names", bag(states=one_state(
        bytes(Cdr().add("i", 1).add("I", 0).text("base").add("I", 0xffffffff)))),
        "log.db3: topic /joint_states, message 4: says that 4294967295 values follow, and 0 "
        "bytes do; expected a message of sensor_msgs/msg/JointState"),
    Row("text without end", bag(states=one_state(
        bytes(Cdr().add("i", 1).add("I", 0).add("I", 4)) + b"baseball" * 20)),
        "log.db3: topic /joint_states, message 4: holds a text without its end; expected a "
        "message of sensor_msgs/msg/JointState"),
    Row("more positions than names", bag(states=one_state(state(3, position=(0.0, 1.0, 2.0)))),
        "log.db3: topic /joint_states, message 4: has 2 names and 3 values of position; "
        "expected a message of sensor_msgs/msg/JointState"),
    Row("joint twice", bag(states=one_state(state(3, names=("joint1", "joint1")))),
        "log.db3: topic /joint_states, message 4: names the joint joint1 twice; expected a "
        "message of sensor_msgs/msg/JointState"),
    Row("nan", bag(states=one_state(state(3, position=(float("nan"), 0.0)))),
        "log.db3: row 5, column q1: found 'nan': expected a finite number"),
    Row("nanoseconds beyond a second", bag(states=one_state(state(3, nanoseconds=1 << 31))),
        "log.db3: topic /joint_states, message 4: has 2147483648 ns in its stamp, expected "
        "less than a second; expected a message of sensor_msgs/msg/JointState"),
    Row("time backwards", bag(states=one_state(state(3, nanoseconds=0))),
        "log.db3: row 5, column t [ns]: found '1000000000': time runs backwards, the row "
        "before has 1020000000"),
    Row("another robot's joints", bag(states=[state(k, names=("a", "b")) for k in range(40)]),
        "log.db3: no message gives the position of joint1, joint2; the bag has "
        "/joint_states (sensor_msgs/msg/JointState of a, b)"),
    Row("stamps all 0", bag(states=[s[:4] + bytes(8) + s[12:] for s in STATES]),
        "log.db3: topic /joint_states: the stamps in the headers are all 0: expected times"),
    Row("packed message that is damaged", bag(states=one_state(b"\x28\xb5\x2f\xfd\x20\x40" + b"\xff" * 20)),
        "log.db3: topic /joint_states, message 4: is packed by zstd and damaged; expected a "
        "message of sensor_msgs/msg/JointState"),
    Row("packed message of 1 TB", bag(states=one_state(
        b"\x28\xb5\x2f\xfd\xe0" + struct.pack("<Q", 1 << 40) + b"\1\0\0")),
        "log.db3: topic /joint_states, message 4: is packed by zstd and damaged; expected a "
        "message of sensor_msgs/msg/JointState"),
])

MAGIC = b"\x89MCAP0\r\n"


def record(opcode, data, size=None):
    return bytes([opcode]) + struct.pack("<Q", len(data) if size is None else size) + data


def schema(name=STATE):
    return record(3, struct.pack("<H", 1) + text(name) + text("ros2msg") + text(""))


def channel(encoding="cdr"):
    return record(4, struct.pack("<2H", 1, 1) + text("/joint_states") + text(encoding) + text(""))


def message(k, data=None, of=1):
    time = 10**9 + k * 10**7
    return record(5, struct.pack("<HIQQ", of, k, time, time) + (data or STATES[k]))


ABOUT = schema() + channel()
END = record(15, bytes(4)) + record(2, bytes(20)) + MAGIC


def chunk(data, method="", size=None, crc=0, packed_size=None):
    return record(6, struct.pack("<QQQI", 0, 1 << 62, len(data) if size is None else size, crc)
                  + text(method) + struct.pack("<Q", len(data) if packed_size is None else packed_size)
                  + data)


def mcap(*records, end=END):
    return MAGIC + record(1, text("ros2") + text("")) + b"".join(records) + end


MESSAGES = b"".join(message(k) for k in range(40))
WHOLE = mcap(ABOUT + MESSAGES)


def zstd_of_zeros(size):
    """A frame of blocks that repeat a byte 128 KiB times: 4 bytes each."""
    blocks = size >> 17
    return (b"\x28\xb5\x2f\xfd\xa0" + struct.pack("<I", size) + b"".join(
        struct.pack("<I", (1 << 17 << 3 | 1 << 1 | (k + 1 == blocks)))[:3] + b"\0"
        for k in range(blocks)))


def lz4_of_zeros(blocks):
    """A frame of blocks of 4 MiB, each a byte and a match of all the rest."""
    rest = (4 << 20) - 1 - 4 - 15 - 5
    block = (b"\x1f\0\1\0" + b"\xff" * (rest // 255) + bytes([rest % 255]) + b"\x50" + bytes(5))
    return (b"\x04\x22\x4d\x18\x60\x70\x73" +
            (struct.pack("<I", len(block)) + block) * blocks + bytes(4))


MCAP = Group("MCAP", "calibrate --robot=robot.yaml --log=log.mcap --out=out",
             {"robot.yaml": ARM, "log.mcap": WHOLE, "packed.mcap": "@zstd.mcap",
              "lz4.mcap": "@lz4.mcap"}, [
    Row("first bytes alone", written("log.mcap", MAGIC),
        "log.mcap: byte 8: is cut off; `mcap recover` saves what is whole"),
    Row("cut in a record", cut("log.mcap", 3000),
        "log.mcap: byte 2877: is cut off; `mcap recover` saves what is whole"),
    Row("no end", written("log.mcap", mcap(ABOUT + MESSAGES, end=b"")),
        "log.mcap: byte 5366: is cut off; `mcap recover` saves what is whole"),
    Row("no messages", written("log.mcap", mcap(ABOUT)),
        "log.mcap: no message gives the position of joint1, joint2; the bag has "
        "/joint_states (sensor_msgs/msg/JointState)"),
    Row("no records", written("log.mcap", mcap()),
        "log.mcap: no message gives the position of joint1, joint2; the bag has no topics"),
    Row("record longer than the file", written("log.mcap", mcap(ABOUT, record(5, b"", 1 << 62))),
        "log.mcap: byte 126: is cut off; `mcap recover` saves what is whole"),
    Row("record of -1 bytes", written("log.mcap", mcap(ABOUT, record(5, b"", (1 << 64) - 1))),
        "log.mcap: byte 126: is cut off; `mcap recover` saves what is whole"),
    Row("record of 32 GB in a sparse file", both(
        written("log.mcap", mcap(ABOUT, record(5, b"", 1 << 35), end=b"")), padded("log.mcap", 1 << 36)),
        "log.mcap: byte 34359738503: has a record of more than 1 GB; `mcap recover` saves "
        "what is whole"),
    Row("record of 3 bytes", written("log.mcap", mcap(ABOUT, record(5, b"abc"))),
        "log.mcap: byte 138: is damaged: a message is of no channel; `mcap recover` saves "
        "what is whole"),
    Row("message of no channel", written("log.mcap", mcap(ABOUT, message(0, of=7))),
        "log.mcap: byte 257: is damaged: a message is of no channel; `mcap recover` saves "
        "what is whole"),
    Row("channel of no schema", written("log.mcap", mcap(channel(), MESSAGES)),
        "log.mcap: byte 70: is damaged: topic /joint_states is of no schema; `mcap recover` "
        "saves what is whole"),
    Row("schema text longer than its record", written("log.mcap", mcap(
        record(3, struct.pack("<HI", 1, 0x7fffffff)))),
        "log.mcap: byte 44: is damaged: a record is too short; `mcap recover` saves what is "
        "whole"),
    Row("messages in JSON", written("log.mcap", mcap(schema(), channel("json"), MESSAGES)),
        "log.mcap: topic /joint_states: found 'json': expected messages encoded as cdr, as "
        "in ROS 2"),
    Row("topic of another type", written("log.mcap", mcap(schema("x/msg/Y"), channel(), MESSAGES)),
        "log.mcap: no message gives the position of joint1, joint2; the bag has "
        "/joint_states (x/msg/Y)"),
    Row("message cut", written("log.mcap", mcap(ABOUT, message(0), message(1, STATES[1][:50]))),
        "log.mcap: topic /joint_states, message 2: says that 7 values follow, and 6 bytes "
        "do; expected a message of sensor_msgs/msg/JointState"),
    Row("chunk with wrong checksum", written("log.mcap", mcap(chunk(ABOUT + MESSAGES, crc=12345))),
        "log.mcap: byte 5415: is damaged: a chunk's checksum is wrong; `mcap recover` saves "
        "what is whole"),
    Row("chunk of unknown packing", written("log.mcap", mcap(chunk(ABOUT, "brotli"))),
        "log.mcap: byte 181: found 'brotli': expected chunks packed by zstd, lz4 or not at "
        "all; `mcap compress` packs them anew"),
    Row("chunk longer than it says", written("log.mcap", mcap(chunk(ABOUT, size=10))),
        "log.mcap: byte 175: is damaged: a chunk cannot be unpacked; `mcap recover` saves "
        "what is whole"),
    Row("chunk of 1 TB", written("log.mcap", mcap(chunk(b"abc", "zstd", 1 << 40))),
        "log.mcap: byte 85: is damaged: a chunk says that its 3 bytes unpack to "
        "1099511627776; `mcap recover` saves what is whole"),
    Row("chunk of 900 MB in 3 bytes", written("log.mcap", mcap(chunk(b"abc", "zstd", 900 << 20))),
        "log.mcap: byte 85: is damaged: a chunk says that its 3 bytes unpack to 943718400; "
        "`mcap recover` saves what is whole"),
    Row("chunk of 900 MB in 3 bytes by lz4", written("log.mcap", mcap(chunk(b"abc", "lz4", 900 << 20))),
        "log.mcap: byte 84: is damaged: a chunk says that its 3 bytes unpack to 943718400; "
        "`mcap recover` saves what is whole"),
    Row("chunk whose bytes end later", written("log.mcap", mcap(chunk(ABOUT, packed_size=1 << 33))),
        "log.mcap: byte 175: is damaged: a record is too short; `mcap recover` saves what "
        "is whole"),
    Row("zstd bomb", written("log.mcap", mcap(chunk(zstd_of_zeros(512 << 20), "zstd", 512 << 20))),
        "log.mcap: byte 16475: is damaged: a chunk says that its 16393 bytes unpack to "
        "536870912; `mcap recover` saves what is whole"),
    Row("lz4 bomb", written("log.mcap", mcap(chunk(lz4_of_zeros(64), "lz4", 256 << 20))),
        "log.mcap: byte 1053724: is damaged: a record is too short; `mcap recover` saves "
        "what is whole"),
    Row("chunk of chunks", written("log.mcap", mcap(chunk(chunk(ABOUT + MESSAGES)))),
        "log.mcap: no message gives the position of joint1, joint2; the bag has no topics"),
    Row("zstd damaged", edited("packed.mcap", lambda x: x[:300] + bytes([x[300] ^ 255]) + x[301:]),
        "packed.mcap: byte 860: is damaged: a chunk's checksum is wrong; `mcap recover` "
        "saves what is whole", "calibrate --robot=robot.yaml --log=packed.mcap"),
    Row("lz4 damaged", edited("lz4.mcap", lambda x: x[:900] + bytes([x[900] ^ 255]) + x[901:]),
        "lz4.mcap: byte 1363: is damaged: a chunk's checksum is wrong; `mcap recover` saves "
        "what is whole", "calibrate --robot=robot.yaml --log=lz4.mcap"),
])

METADATA = """rosbag2_bagfile_information:
  version: 5
  storage_identifier: mcap
  relative_file_paths:
    - log_0.mcap
"""


def metadata(old, new):
    return replaced("bag/metadata.yaml", old, new)


FOLDER = Group("bag folder", "calibrate --robot=robot.yaml --log=bag --out=out",
               {"robot.yaml": ARM, "bag/metadata.yaml": METADATA, "bag/log_0.mcap": WHOLE}, [
    Row("empty", both(removed("bag/metadata.yaml"), removed("bag/log_0.mcap")),
        "bag: is a folder without a bag: expected one of rosbag2, with metadata.yaml and "
        ".db3 or .mcap files"),
    Row("other files alone", both(removed("bag/metadata.yaml"), written("bag/log_0.mcap", "text")),
        "bag: is a folder without a bag: expected one of rosbag2, with metadata.yaml and "
        ".db3 or .mcap files"),
    Row("file missing", removed("bag/log_0.mcap"),
        "bag/metadata.yaml: line 5, rosbag2_bagfile_information.relative_file_paths[1]: "
        "found 'log_0.mcap': this file is not in the folder"),
    Row("file empty", written("bag/log_0.mcap", ""),
        "bag/log_0.mcap: is not a bag: expected SQLite or MCAP"),
    Row("file packed as a whole", written("bag/log_0.mcap", b"\x28\xb5\x2f\xfd\x04\x00\x01\x00\x00"),
        "bag/log_0.mcap: is packed by zstd as a whole: unpack it with unzstd and name the "
        "file"),
    Row("file is a folder", a_folder("bag/log_0.mcap"),
        "bag/metadata.yaml: line 5, rosbag2_bagfile_information.relative_file_paths[1]: "
        "found 'log_0.mcap': this file is not in the folder"),
    Row("file is a device", linked("bag/log_0.mcap", "/dev/zero"),
        "bag/metadata.yaml: line 5, rosbag2_bagfile_information.relative_file_paths[1]: "
        "found 'log_0.mcap': this file is not in the folder"),
    Row("path outside", metadata("log_0.mcap", "../../../../etc/passwd"),
        "bag/metadata.yaml: line 5, rosbag2_bagfile_information.relative_file_paths[1]: "
        "found '../../../../etc/passwd': this file is not in the folder"),
    Row("absolute path", metadata("log_0.mcap", "/etc/passwd"),
        "bag/metadata.yaml: line 5, rosbag2_bagfile_information.relative_file_paths[1]: "
        "found '/etc/passwd': this file is not in the folder"),
    Row("the folder itself", metadata("log_0.mcap", ".."),
        "bag/metadata.yaml: line 5, rosbag2_bagfile_information.relative_file_paths[1]: "
        "found '..': this file is not in the folder"),
    Row("no name", metadata("log_0.mcap", "''"),
        "bag/metadata.yaml: line 5, rosbag2_bagfile_information.relative_file_paths[1]: "
        "expected a name"),
    Row("file twice", metadata("- log_0.mcap", "- log_0.mcap\n    - log_0.mcap"),
        "bag/metadata.yaml: line 6, rosbag2_bagfile_information.relative_file_paths[2]: "
        "found 'log_0.mcap': this file is named twice"),
    Row("no files", metadata("\n    - log_0.mcap", " []"),
        "bag: is a folder without a bag: expected one of rosbag2, with metadata.yaml and "
        ".db3 or .mcap files"),
    Row("no list of files", metadata("relative_file_paths", "files"),
        "bag/metadata.yaml: line 2, rosbag2_bagfile_information: expected a key "
        "'relative_file_paths'"),
    Row("other information", metadata("rosbag2_bagfile_information", "bag"),
        "bag/metadata.yaml: line 1: expected a key 'rosbag2_bagfile_information'"),
    Row("metadata empty", written("bag/metadata.yaml", ""),
        "bag/metadata.yaml: the file is empty"),
    Row("metadata damaged", metadata("version: 5", "version: [5"),
        "bag/metadata.yaml: line 3: not well-formed YAML (end of sequence flow not found)"),
    Row("metadata binary", written("bag/metadata.yaml", bytes(100)),
        "bag/metadata.yaml: contains NUL bytes: expected UTF-8 text"),
    Row("metadata is a folder", a_folder("bag/metadata.yaml"),
        "bag/metadata.yaml: is a folder: expected a file"),
    Row("metadata is a device", linked("bag/metadata.yaml", "/dev/zero"),
        "bag/metadata.yaml: is larger than 1 MiB, the most that such a file may have"),
])
GROUPS = [DB3, SENSOR, MCAP, FOLDER]
