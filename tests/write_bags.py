"""write_bags.py LOG.csv FOLDER: a log of t, q1.., tau1.. as others write it.

Bags of ROS 2 by rosbags, mcap and mcap-ros2-support, .mat by SciPy, v7.3 by h5py:
none shares code with armcal. They are on PyPI (data/log_formats/README.md).
"""

import pathlib
import shutil
import sys

import h5py
import numpy as np
import scipy.io
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from mcap_ros2.writer import Writer as Ros2Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as BagWriter
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

ROS = get_typestore(Stores.ROS2_HUMBLE)
STATE = 'sensor_msgs/msg/JointState'
ARRAY = 'std_msgs/msg/Float64MultiArray'
CONTROL = 'control_msgs/msg/'
# As ros2_control has had them since ROS 2 Humble.
for name, text in {
        'InterfaceValue': 'string[] interface_names\nfloat64[] values\n',
        'DynamicJointState': ('std_msgs/Header header\nstring[] joint_names\n'
                              'control_msgs/InterfaceValue[] interface_values\n'),
        'JointTrajectoryControllerState': 'std_msgs/Header header\nstring[] joint_names\n' + ''.join(
            f'trajectory_msgs/JointTrajectoryPoint {point}\n'
            for point in ('reference', 'feedback', 'error', 'output')) +
            'string[] multi_dof_joint_names\n' + ''.join(
            f'trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_{point}\n'
            for point in ('reference', 'feedback', 'error', 'output'))}.items():
    ROS.register(get_types_from_msg(text, CONTROL + name))
START = 1_700_000_000_000_000_000  # ns, of the first stamp
LATENCY = 1_234_567  # ns, from a stamp to its reception
FEW = 20  # messages where the log as a whole is not needed


def state(stamp, names, position=(), velocity=(), effort=()):
    """The arguments of a JointState."""
    stamp = ROS.types['builtin_interfaces/msg/Time'](sec=stamp // 10**9, nanosec=stamp % 10**9)
    return ROS.types[STATE](
        header=ROS.types['std_msgs/msg/Header'](stamp=stamp, frame_id='base'), name=list(names),
        position=np.asarray(position, float), velocity=np.asarray(velocity, float),
        effort=np.asarray(effort, float))


def cdr(message, little_endian=True):
    return bytes(ROS.serialize_cdr(message, message.__msgtype__, little_endian=little_endian))


class Log:
    def __init__(self, path):
        table = np.genfromtxt(path, delimiter=',', names=True)
        self.joints = sum(name.startswith('tau') for name in table.dtype.names)
        self.t = table['t']
        self.q = self.signal(table, 'q')
        self.tau = self.signal(table, 'tau')
        self.stamps = [START + round(t * 1e9) for t in self.t]
        self.names = [f'joint{j + 1}' for j in range(self.joints)]

    def signal(self, table, name):
        return np.stack([table[f'{name}{j + 1}'] for j in range(self.joints)], axis=1)

    def states(self, names=None, effort=lambda tau: tau):
        """(received, message) of each sample."""
        for stamp, q, tau in zip(self.stamps, self.q, self.tau):
            yield stamp + LATENCY, state(stamp, names or self.names, q, (), effort(tau))

    def mixed_states(self):
        """In any order of names, between messages of a gripper."""
        random = np.random.default_rng(1)
        for k, (stamp, q, tau) in enumerate(zip(self.stamps, self.q, self.tau)):
            order = random.permutation(self.joints)
            names = [self.names[j] for j in order]
            yield stamp + LATENCY, state(stamp, names, q[order], np.zeros(self.joints), tau[order])
            if k % 5 == 2:
                yield stamp + LATENCY + 9, state(stamp + 9, ['finger'], [0.1], [], [np.nan])


def bag(folder, plugin, topics, compression=CompressionMode.NONE):
    """rosbags' folder of `topics`, {name: [(received, message)]}."""
    shutil.rmtree(folder, ignore_errors=True)
    writer = BagWriter(folder, version=9, storage_plugin=plugin)
    writer.set_compression(compression, CompressionFormat.ZSTD)
    with writer:
        for name, messages in topics.items():
            messages = list(messages)
            connection = writer.add_connection(name, messages[0][1].__msgtype__, typestore=ROS)
            for received, message in messages:
                writer.write(connection, received, cdr(message))


def mcap(path, topics, encoding='cdr', **options):
    """A file of `topics`, {name: (type, [(received, bytes)])}."""
    writer = McapWriter(str(path), **options)
    writer.start('ros2', 'write_bags.py')
    channels = {}
    for name, (kind, _) in topics.items():
        text = ROS.generate_msgdef(kind, ros_version=2)[0] if kind in ROS.types else ''
        schema = writer.register_schema(kind, 'ros2msg', text.encode())
        channels[name] = writer.register_channel(name, encoding, schema)
    messages = [(received, name, data) for name, (_, all) in topics.items()
                for received, data in all]
    for received, name, data in sorted(messages, key=lambda m: m[0]):
        writer.add_message(channels[name], received, data, received)
    writer.finish()


def packed(messages, little_endian=True):
    return STATE, [(received, cdr(message, little_endian)) for received, message in messages]


def few(messages):
    return [message for message, _ in zip(messages, range(FEW))]


def write_whole(log, folder):
    """Files that all hold the whole log."""
    chatter = [(log.stamps[0] + k, ROS.types['std_msgs/msg/String'](data='x' * k)) for k in range(9)]
    bag(folder / 'db3', StoragePlugin.SQLITE3, {'/chatter': chatter,
                                                '/joint_states': log.mixed_states()})
    shutil.move(folder / 'db3' / 'db3.db3', folder / 'log.db3')
    shutil.rmtree(folder / 'db3')
    mixed = {'/joint_states': packed(log.mixed_states())}
    small = {'chunk_size': 4096}
    mcap(folder / 'zstd.mcap', mixed, compression=CompressionType.ZSTD, **small)
    mcap(folder / 'plain.mcap', {'/joint_states': packed(log.states())}, use_chunking=False)
    mcap(folder / 'big_endian.mcap', {'/joint_states': packed(log.states(), False)}, **small)
    arrays = [(received, cdr(ROS.types[ARRAY](
        layout=ROS.types['std_msgs/msg/MultiArrayLayout'](dim=[], data_offset=0), data=tau)))
        for (received, _), tau in zip(log.states(), log.tau)]
    mcap(folder / 'two_topics.mcap', {
        '/joint_states': packed(log.states(effort=lambda tau: tau * 0)),
        '/torques': (ARRAY, arrays)}, **small)
    write_lz4(log, folder / 'lz4.mcap')
    write_split(log, folder / 'split')


def write_ros2_control(log, path):
    """What its controllers publish: reference is 0.125 rad beside the position, velocity 2."""
    def point(position, velocity=(), effort=()):
        return ROS.types['trajectory_msgs/msg/JointTrajectoryPoint'](
            positions=np.asarray(position, float), velocities=np.asarray(velocity, float),
            accelerations=np.zeros(0), effort=np.asarray(effort, float),
            time_from_start=ROS.types['builtin_interfaces/msg/Duration'](sec=1, nanosec=2))

    def controller_state(stamp, q, tau):
        nothing = ROS.types['trajectory_msgs/msg/MultiDOFJointTrajectoryPoint'](
            transforms=[], velocities=[], accelerations=[],
            time_from_start=ROS.types['builtin_interfaces/msg/Duration'](sec=0, nanosec=0))
        return ROS.types[CONTROL + 'JointTrajectoryControllerState'](
            header=state(stamp, []).header, joint_names=log.names,
            reference=point(q + .125), feedback=point(q, q * 0 + 2, tau), error=point(q * 0 + .125),
            output=point([]), multi_dof_joint_names=[], multi_dof_reference=nothing,
            multi_dof_feedback=nothing, multi_dof_error=nothing, multi_dof_output=nothing)

    def dynamic_state(stamp, q, tau):
        def value(**values):
            return ROS.types[CONTROL + 'InterfaceValue'](
                interface_names=list(values), values=np.array(list(values.values())))
        # In any order, also of what no log holds, and of a joint without effort.
        return ROS.types[CONTROL + 'DynamicJointState'](
            header=state(stamp, []).header, joint_names=log.names[::-1] + ['finger'],
            interface_values=[value(temperature=40., effort=tau[j], position=q[j])
                              for j in reversed(range(log.joints))] + [value(position=.5)])

    samples = few(zip(log.stamps, log.q, log.tau))
    mcap(path, {
        '/joint_states': packed(few(log.states())),
        '/arm_controller/controller_state': (CONTROL + 'JointTrajectoryControllerState', [
            (stamp + LATENCY, cdr(controller_state(stamp, q, tau))) for stamp, q, tau in samples]),
        '/dynamic_joint_states': (CONTROL + 'DynamicJointState', [
            (stamp + LATENCY, cdr(dynamic_state(stamp, q, tau))) for stamp, q, tau in samples])})


def write_wrench(log, path):
    """Joint states beside a sensor that measures between them and is received later: its axis c
    says 10 c + k where the message k + 1 of the joints has its stamp, by way of a straight line."""
    wrench, vector = (ROS.types[f'geometry_msgs/msg/{name}'] for name in ('WrenchStamped', 'Vector3'))
    step = log.stamps[1] - log.stamps[0]

    def sensor(k):
        stamp = log.stamps[0] + k * step - step // 4
        six = [10. * c + k - .25 for c in range(6)]
        message = wrench(header=state(stamp, []).header, wrench=ROS.types['geometry_msgs/msg/Wrench'](
            force=vector(*six[:3]), torque=vector(*six[3:])))
        return stamp + 10 * LATENCY, cdr(message)

    kind = 'geometry_msgs/msg/WrenchStamped'
    messages = [sensor(k) for k in range(FEW + 1)]
    mcap(path, {'/joint_states': packed(few(log.states())), '/ft': (kind, messages),
                '/external': (kind, messages)})


def write_lz4(log, path):
    """By mcap-ros2-support, which has a CDR of its own."""
    with open(path, 'wb') as file:
        writer = Ros2Writer(file, chunk_size=4096, compression=CompressionType.LZ4)
        schema = writer.register_msgdef(STATE, ROS.generate_msgdef(STATE, ros_version=2)[0])
        for stamp, q, tau in zip(log.stamps, log.q, log.tau):
            writer.write_message('/joint_states', schema, {
                'header': {'stamp': {'sec': stamp // 10**9, 'nanosec': stamp % 10**9},
                           'frame_id': ''},
                'name': log.names, 'position': list(q), 'velocity': [], 'effort': list(tau)},
                stamp + LATENCY)
        writer.finish()


def write_split(log, folder):
    """rosbag2's folder of two files, the first messages in the first."""
    states = list(log.states())
    half = len(states) // 2
    bag(folder, StoragePlugin.MCAP, {'/joint_states': states[:half]})
    shutil.move(folder / 'split.mcap', folder / 'split_0.mcap')
    bag(folder.parent / 'rest', StoragePlugin.MCAP, {'/joint_states': states[half:]})
    shutil.move(folder.parent / 'rest' / 'rest.mcap', folder / 'split_1.mcap')
    shutil.rmtree(folder.parent / 'rest')
    metadata = folder / 'metadata.yaml'
    text = metadata.read_text()
    line = next(line for line in text.splitlines() if line.strip() == '- split.mcap')
    both = line.replace('split.mcap', 'split_0.mcap') + '\n' + line.replace('split.mcap', 'split_1.mcap')
    metadata.write_text(text.replace(line, both, 1))


def write_beginnings(log, folder):
    """The first messages, packed one by one; one joint in each of two topics."""
    bag(folder / 'packed', StoragePlugin.MCAP, {'/joint_states': few(log.states())},
        CompressionMode.MESSAGE)

    def half(j):
        return STATE, few([(stamp, cdr(state(stamp, [log.names[j]], [q[j]], [], [tau[j]])))
                           for stamp, q, tau in zip(log.stamps, log.q, log.tau)])
    mcap(folder / 'halves.mcap', {'/left': half(0), '/right': half(1)})


def write_refused(log, folder):
    """What cannot be read as it is, or only with a flag."""
    def write(name, messages, kind=STATE, **options):
        mcap(folder / f'{name}.mcap', {'/joint_states': (kind, messages)}, **options)

    write('nan_effort', few(packed(log.states(effort=lambda tau: tau * np.nan))[1]))
    write('empty_effort', few(packed(log.states(effort=lambda tau: ()))[1]))
    once = packed(log.states())[1]
    received, message = list(log.states())[5]
    message.effort = message.effort * np.nan
    write('one_nan', few(once[:5] + [(received, cdr(message))] + once[6:]))
    write('short_message', few([(r, m[:-8] if k == 7 else m) for k, (r, m) in enumerate(once)]))
    write('odd_type', few(once), kind='std_msgs/msg/Float32MultiArray')
    write('json', few([(r, b'{}') for r, _ in once]), encoding='json')
    write('no_stamps', few([(r, m[:4] + bytes(8) + m[12:]) for r, m in once]))
    names = [f'{name}_of_the_left_arm_joint' for name in ('shoulder', 'elbow', 'wrist')]
    write('long_names', few([(r, cdr(state(r, names, [0, 0, 0]))) for r, _ in once]))
    mcap(folder / 'two_arms.mcap', {'/joint_states': (STATE, few(once)),
                                    '/simulated/joint_states': (STATE, few(once))})


def matlab_class(item, name):
    """MATLAB ends the text by a 0 byte where h5py would fill it up."""
    kind = h5py.h5t.C_S1.copy()
    kind.set_size(len(name))
    kind.set_strpad(h5py.h5t.STR_NULLTERM)
    space = h5py.h5s.create(h5py.h5s.SCALAR)
    h5py.h5a.create(item.id, b'MATLAB_class', kind, space).write(np.array(name, f'S{len(name)}'), kind)


def write_mat(log, folder):
    signals = {'t': log.t, 'q': log.q, 'tau': log.tau}
    scipy.io.savemat(folder / 'v4.mat', signals, format='4')
    scipy.io.savemat(folder / 'v5.mat', {
        'gains': np.ones(3), 'log': {
            'time': log.t, 'position': log.q[:, ::-1], 'effort': log.tau[:, ::-1],
            'joint_names': np.array(log.names[::-1], dtype=object)}}, do_compression=True)
    with h5py.File(folder / 'v73.mat', 'w', userblock_size=512) as file:
        for name, values in signals.items():
            data = np.atleast_2d(values.T)
            matlab_class(file.create_dataset(name, data=data, chunks=data.shape, compression='gzip',
                                             shuffle=True), 'double')
    with open(folder / 'v73.mat', 'r+b') as file:
        file.write(b'MATLAB 7.3 MAT-file, by h5py'.ljust(124) + b'\x00\x02IM')


def main():
    log = Log(sys.argv[1])
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(exist_ok=True)
    write_whole(log, folder)
    write_beginnings(log, folder)
    write_refused(log, folder)
    write_ros2_control(log, folder / 'ros2_control.mcap')
    write_wrench(log, folder / 'wrench.mcap')
    write_mat(log, folder)


if __name__ == '__main__':
    main()
