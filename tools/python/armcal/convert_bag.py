"""Bags of ROS 1, as bags of ROS 2 (armcal.convert)."""

from __future__ import annotations

import pathlib
import shutil
from typing import Any, Dict, List

from armcal._armcal import InputError

# What armcal's reader of bags takes, and where in a message of ROS 1 the
# header's stamp is: after 4 bytes of `seq`, s and ns of 4 bytes each.
_JOINTS = ("sensor_msgs/msg/JointState",
           "control_msgs/msg/JointTrajectoryControllerState")
_STAMPED = _JOINTS + ("geometry_msgs/msg/WrenchStamped",)
_TYPES = _STAMPED + ("std_msgs/msg/Float64MultiArray",)
_STAMP = slice(4, 12)


def _listed(connections: Any) -> str:
    """"/joint_states (sensor_msgs/JointState), /rosout (..)"."""
    topics = {f"{c.topic} ({c.msgtype.replace('/msg/', '/')})"
              for c in connections}
    return ", ".join(sorted(topics)) or "no topics"


def _ros2_types(reader: Any) -> Any:
    """The bag's own message types with ROS 2's header, which has no `seq`."""
    from rosbags.typesys import Stores, get_typestore
    header = "std_msgs/msg/Header"
    types = get_typestore(Stores.EMPTY)
    types.register({
        **reader.typestore.fielddefs,
        header: get_typestore(Stores.ROS2_HUMBLE).fielddefs[header]})
    return types


def _copy(reader: Any, used: Any, writer: Any) -> Dict[str, int]:
    """Writes the messages of the connections `used`; how many of each topic."""
    types = _ros2_types(reader)
    made: Dict[Any, Any] = {}
    for connection in used:
        # Several nodes may publish one topic.
        key = (connection.topic, connection.msgtype)
        if key not in made:
            made[key] = writer.add_connection(*key, typestore=types)
    counts = {topic: 0 for topic, _ in made}
    # A sensor's that are none are refused where it is asked for.
    stamped = {topic: kind not in _JOINTS for topic, kind in made}
    for connection, received, data in reader.messages(connections=used):
        key = (connection.topic, connection.msgtype)
        writer.write(made[key], received, types.ros1_to_cdr(data, key[1]))
        counts[key[0]] += 1
        stamped[key[0]] = stamped[key[0]] or any(data[_STAMP])
    for topic, has_stamps in stamped.items():
        if counts[topic] > 0 and not has_stamps:
            raise InputError(f"topic {topic}: the stamps in the headers are "
                             "all 0: expected times")
    return counts


def ros1_to_ros2(path: pathlib.Path, folder: pathlib.Path) -> List[str]:
    """Writes `folder`, a bag of ROS 2 with the topics that armcal reads."""
    try:
        from rosbags.highlevel import AnyReader, AnyReaderError
        from rosbags.rosbag1 import ReaderError
        from rosbags.rosbag2 import StoragePlugin, Writer
    except ImportError as error:
        raise ImportError("a bag of ROS 1 needs the package rosbags, `pip "
                          f"install rosbags`: {error}") from None
    try:
        with AnyReader([path]) as reader:
            used = [c for c in reader.connections
                    if c.msgtype in _TYPES and c.msgcount > 0]
            if not any(c.msgtype in _JOINTS for c in used):
                raise InputError(
                    "has no messages of sensor_msgs/JointState or control_msgs/"
                    "JointTrajectoryControllerState; it has " +
                    _listed(reader.connections))
            with Writer(folder, version=9,
                        storage_plugin=StoragePlugin.MCAP) as writer:
                counts = _copy(reader, used, writer)
            others = [c for c in reader.connections if c not in used]
    except InputError as error:
        shutil.rmtree(folder, ignore_errors=True)
        raise InputError(f"{path}: {error}") from None
    except (AnyReaderError, ReaderError) as error:
        shutil.rmtree(folder, ignore_errors=True)
        raise InputError(f"{path}: {error}; a bag that was not closed is mended "
                         "by `rosbag reindex`") from None
    sentences = [f"{folder}: {count} messages of {topic}"
                 for topic, count in sorted(counts.items())]
    if others:
        sentences.append(f"left out: {_listed(others)}")
    return sentences
