"""write_npz.py LOG.csv FOLDER: the log as NumPy archives, whole and damaged."""

import pathlib
import sys

import numpy as np


def main():
    log = np.genfromtxt(sys.argv[1], delimiter=',', names=True)
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(exist_ok=True)
    columns = {name: log[name] for name in log.dtype.names}
    joints = sum(name.startswith('tau') for name in columns)

    def signal(name):
        return np.stack([columns[f'{name}{j + 1}'] for j in range(joints)], axis=1)

    np.savez_compressed(folder / 'columns.npz', **columns, note=np.array('mine'))
    np.savez(folder / 'signals.npz', t=columns['t'], q=np.asfortranarray(signal('q')),
             effort=signal('tau'), gains=np.ones((3, 3)), empty=np.zeros(0))
    np.savez(folder / 'named.npz', time=columns['t'], position=signal('q')[:, ::-1],
             effort=signal('tau')[:, ::-1],
             joint_names=np.array([f'joint{joints - j}' for j in range(joints)]))
    np.savez(folder / 'single.npz', t=columns['t'], q=signal('q').astype(np.float32),
             tau=np.round(signal('tau')).astype(np.int16))

    np.savez(folder / 'short.npz', t=columns['t'], q=signal('q')[:-1], tau=signal('tau'))
    np.savez(folder / 'timeless.npz', q=signal('q'), tau=signal('tau'))
    np.savez(folder / 'nan.npz', t=columns['t'], q=signal('q'),
             tau=np.where(np.arange(len(log))[:, None] == 5, np.nan, signal('tau')))
    whole = (folder / 'columns.npz').read_bytes()
    (folder / 'cut.npz').write_bytes(whole[:len(whole) // 2])
    at = len(whole) // 3
    (folder / 'damaged.npz').write_bytes(whole[:at] + bytes([whole[at] ^ 255]) + whole[at + 1:])
    with open(folder / 'objects.npz', 'wb') as file:
        np.savez(file, t=columns['t'], q=signal('q'),
                 tau=np.array([{'a': 1}] * len(log), dtype=object))


if __name__ == '__main__':
    main()
