"""Runs armcal on a pseudo-terminal: colours, progress, Ctrl-C, two at once.

terminal.py ARMCAL, in a folder with arm.yaml.
"""
import fcntl
import os
import pty
import re
import signal
import struct
import subprocess
import sys
import termios
import time

ARMCAL = sys.argv[1]
ROBOT = '--robot=arm.yaml'
CLEAR = '\r\x1b[K'


class Terminal:
    """A run whose stdout and stderr are one terminal."""

    def __init__(self, *flags, columns=80, **environment):
        child = {k: v for k, v in os.environ.items()
                 if k not in ('CI', 'NO_COLOR')}
        child.update({'TERM': 'xterm', **environment})
        master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ,
                    struct.pack('HHHH', 24, columns, 0, 0))
        self.process = subprocess.Popen(
            [ARMCAL, *flags], stdin=slave, stdout=slave, stderr=slave,
            env=child, start_new_session=True,
            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
        os.close(slave)
        self.master = master
        self.text = ''

    def read(self, until=None):
        """All there is, or up to where `until` matches."""
        while until is None or not re.search(until, self.text):
            try:
                data = os.read(self.master, 65536)
            except OSError:  # the run has ended
                data = b''
            if not data:
                break
            self.text += data.decode()
        return self.text

    def end(self):
        self.read()
        return self.process.wait()


def expect(holds, what, text=''):
    if not holds:
        sys.exit(f'{what}\n{text!r}')


def colours():
    run = Terminal('verify', ROBOT)
    expect(run.end() == 0, 'verified expected', run.text)
    expect('\x1b[1;32marm: verified\x1b[0m\r\n' in run.text,
           'a green verdict expected', run.text)
    for environment in ({'NO_COLOR': '1'}, {'TERM': 'dumb'}):
        run = Terminal('verify', ROBOT, **environment)
        run.end()
        expect('\x1b[1' not in run.text, f'colours in spite of {environment}',
               run.text)
    run = Terminal('frobnicate')
    expect(run.end() == 2 and run.text.startswith('\x1b[1;31marmcal:\x1b[0m '),
           'a red name before an error expected', run.text)


def width():
    widest = {}
    for columns in (80, 110):
        run = Terminal('calibrate', '--helpfull', columns=columns)
        run.end()
        widest[columns] = max(map(len, run.text.split('\r\n')))
    expect(widest[80] <= 80 < widest[110] <= 110,
           f'help must be as wide as the terminal, not {widest}')


def progress():
    run = Terminal('simulate', ROBOT, '--duration=600', '--out=long')
    run.read(until=r'step ends in')
    line = run.text.split('\r')[-1]
    expect(re.match(r'simulating +\[#*\.+\] +\d+ %  \d:\d\d, step ends in \d+:\d\d',
                    line), 'share, time and time left expected', run.text)
    expect(all(len(line.replace('\x1b[K', '')) < 80
               for line in run.text.split('\r')), 'too wide', run.text)
    os.write(run.master, b'\x03')  # Ctrl-C
    expect(run.end() == -signal.SIGINT, 'the end by SIGINT expected')
    expect(run.text.endswith(CLEAR) or run.text.rstrip('^C').endswith(CLEAR),
           'the line must be cleared', run.text)
    expect(not os.path.exists('long'), 'a folder was left behind')

    run = Terminal('simulate', ROBOT, '--duration=600', '--out=long')
    run.read(until='simulating')
    run.process.terminate()
    expect(run.end() == -signal.SIGTERM, 'the end by SIGTERM expected')

    # What is printed begins on a clear line.
    run = Terminal('simulate', ROBOT, '--duration=40', '--step=2e-4',
                   '--out=short')
    expect(run.end() == 0, 'a log expected', run.text)
    expect('simulating' in run.text, 'no progress', run.text)
    expect(CLEAR + 'simulated arm' in run.text, 'the line was not cleared',
           run.text)
    run = Terminal('simulate', ROBOT, '--duration=600', '--out=long', CI='1')
    time.sleep(1.8)
    run.process.terminate()
    run.end()
    expect('simulating' not in run.text, 'progress in spite of CI', run.text)


def left(folder):
    return sorted(os.listdir(folder))


def start_and_wait_for_folder(folder):
    """A run that has opened the folder, whose lock it waits for."""
    run = subprocess.Popen([ARMCAL, 'verify', ROBOT, f'--out={folder}'],
                           stdout=subprocess.PIPE)
    files = f'/proc/{run.pid}/fd'

    def is_folder(file):
        try:
            return os.path.samefile(f'{files}/{file}', folder)
        except FileNotFoundError:  # closed since it was listed
            return False

    deadline = time.time() + 60
    while not any(is_folder(file) for file in os.listdir(files)):
        expect(time.time() < deadline, 'the folder was not opened')
        time.sleep(.01)
    return run


def writing():
    """While another run has the folder's lock, results wait."""
    os.makedirs('shared')
    folder = os.open('shared', os.O_RDONLY)
    fcntl.flock(folder, fcntl.LOCK_EX)
    for end in (signal.SIGINT, signal.SIGTERM):
        run = start_and_wait_for_folder('shared')
        run.send_signal(end)
        expect(run.wait() == -end, f'the end by signal {end} expected')
    runs = [start_and_wait_for_folder('shared') for _ in range(2)]
    time.sleep(.2)
    expect(left('shared') == [],
           f'written in spite of the lock: {left("shared")}')
    fcntl.flock(folder, fcntl.LOCK_UN)
    for run in runs:
        run.communicate()
        expect(run.returncode == 0, 'both runs must succeed')
    expect(left('shared') ==
           ['provenance.json', 'report.html', 'verification.json'],
           f'expected the results alone: {left("shared")}')


def ignored():
    """nohup and shells in the background ignore signals; so does armcal."""
    run = subprocess.Popen(
        [ARMCAL, 'simulate', ROBOT, '--duration=12', '--out=ignored'],
        stdout=subprocess.DEVNULL,
        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    time.sleep(.2)
    run.send_signal(signal.SIGHUP)
    expect(run.wait() == 0, 'SIGHUP must stay ignored')


try:
    for end in pty.openpty():
        os.close(end)
except OSError as error:
    print(f'skipped: there are no pseudo-terminals here ({error})')
    sys.exit(0)
for test in (colours, width, progress, writing, ignored):
    start = time.time()
    test()
    print(test.__name__, f'{time.time() - start:.1f} s')
