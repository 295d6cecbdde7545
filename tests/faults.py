"""What goes wrong around armcal: kills, full and read-only disks, logs that
change, memory and locale, paths, several runs at once.

faults.py ARMCAL DATA_DIR KILLS [PYTHON_MODULES]
"""
import ctypes
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ARMCAL, DATA = map(os.path.abspath, sys.argv[1:3])
KILLS = int(sys.argv[3])
MODULES = os.path.abspath(sys.argv[4]) if len(sys.argv) > 4 else ''
ROBOT = f'--robot={DATA}/scara/robot.yaml'
OLD, NEW = [[ARMCAL, 'calibrate', ROBOT, f'--log={DATA}/scara/{log}.csv.gz',
             '--joint_terms=none', '--quiet', '--out=out'] for log in 'AB']
NOTES = 'mine.txt'  # a file that is not armcal's


def expect(holds, what, text=''):
    if not holds:
        sys.exit(f'{what}\n{text}')


def run(command, **how):
    return subprocess.run(command, capture_output=True, text=True, **how)


def results(folder='out'):
    """{name: content} of the results that can be opened in a folder."""
    found = {}
    for name in os.listdir(folder) if os.path.isdir(folder) else ():
        path = os.path.join(folder, name)
        if os.path.isfile(path) and name != NOTES:
            with open(path, 'rb') as file:
                found[name] = file.read()
    return found


def expect_alone(what):
    """Nothing but results and the file that is not armcal's."""
    strange = [name for name in os.listdir('out') if name.startswith('.') or
               os.path.islink(f'out/{name}')]
    expect(not strange, f'{what}: left behind', strange)


def of_commands():
    """What OLD and NEW write where nothing disturbs them, and how long it takes
    from the first change of the folder to the end."""
    sets, writing = [], []
    for command in (OLD, NEW):
        shutil.rmtree('out', ignore_errors=True)
        os.mkdir('out')
        process = subprocess.Popen(command)
        wait_for_change(process, os.stat('out').st_mtime_ns)
        start = time.perf_counter()
        expect(process.wait() == 0, f'{command} must succeed')
        writing.append(time.perf_counter() - start)
        sets.append(results())
    expect(set(sets[0]) == set(sets[1]) and len(sets[0]) > 3, 'several files')
    expect(all(sets[0][name] != sets[1][name] for name in
               ('calibration.json', 'report.html')), 'two different results')
    return sets, max(writing)


def wait_for_change(process, before):
    while process.poll() is None and os.stat('out').st_mtime_ns == before:
        pass


def killed(end, times):
    """At any moment of a run, most of them while it writes: the old results or
    the new ones, all of them, and what is not armcal's."""
    sets, writing = of_commands()
    start = time.perf_counter()
    run(OLD)
    whole = time.perf_counter() - start
    with open(f'out/{NOTES}', 'w', encoding='utf-8') as file:
        file.write('mine')
    now, counts, links = 0, [0, 0], 0
    for k in range(times):
        expect(results() == sets[now], f'{end}: wrong results before run {k}')
        before = os.stat('out').st_mtime_ns
        process = subprocess.Popen((OLD, NEW)[1 - now])
        if k % 4:
            wait_for_change(process, before)
            time.sleep(writing * random.random() ** 3)
        else:
            time.sleep(random.uniform(0, whole))
        process.send_signal(end)
        process.wait()
        found = results()
        expect(found in sets, f'{end}: half old, half new after run {k}',
               {name: [content == s[name] for s in sets]
                for name, content in found.items()})
        new = found == sets[1 - now]
        counts[new] += 1
        links += any(os.path.islink(f'out/{name}') for name in found)
        now = 1 - now if new else now
        if end != signal.SIGKILL:
            expect_alone(end)
    # The next run clears up.
    expect(run((OLD, NEW)[1 - now]).returncode == 0, 'a run after kills')
    expect(results() == sets[1 - now], 'the results of the last run')
    expect_alone('a run after kills')
    with open(f'out/{NOTES}', encoding='utf-8') as file:
        expect(file.read() == 'mine', 'a file that is not armcal\'s')
    print(f'{times} times {signal.Signals(end).name}: {counts[0]} old results, '
          f'{counts[1]} new ones, {links} of all in the middle of the switch')


def expect_refusal(finished, *texts):
    """Exit code 3, one line, the old results."""
    lines = finished.stderr.splitlines()
    expect(finished.returncode == 3 and len(lines) == 1 and
           all(text in lines[0] for text in texts), f'{texts} expected',
           finished)


def without_space():
    run(OLD)
    before = results()

    def small_files():
        resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000))

    # A build that counts its lines has a file of its own to write.
    uncounted = dict(os.environ, LLVM_PROFILE_FILE=os.devnull)
    expect_refusal(run(NEW, preexec_fn=small_files, env=uncounted),
                   'report.html: --out: '
                   'cannot be written: File too large')
    expect(results() == before, 'the old results where files may not be large')
    expect_alone('no space')
    script = ('mount -t tmpfs -o size=200k none "$0" && "$@"; code=$?; '
              'ls -A "$0"; exit $code')
    os.mkdir('small')
    if run(['unshare', '-rm', 'mount', '-t', 'tmpfs', 'none',
            'small']).returncode:
        print('skipped: a full disk, as nothing can be mounted here')
        return
    full = run(['unshare', '-rm', 'sh', '-c', script, 'small',
                *NEW[:-1], '--out=small'])
    expect_refusal(full, 'report.html: --out: cannot be written: No space left')
    expect(full.stdout == '', 'left on the full disk', full.stdout)


def read_only():
    run(OLD)
    before = results()

    def without_capabilities():  # by which root may write anywhere
        drop, override, search = 24, 1, 2
        for capability in (override, search):
            ctypes.CDLL(None).prctl(drop, capability, 0, 0, 0)

    os.chmod('out', 0o555)
    refused = run(NEW, preexec_fn=without_capabilities)
    os.chmod('out', 0o755)
    expect_refusal(refused, 'out: --out: cannot be written: Permission denied')
    expect(results() == before, 'the old results in a folder to be read only')
    expect_alone('read only')


def log_cut_while_read():
    """A log that gets shorter is refused, or was read before."""
    made = run([ARMCAL, 'simulate', ROBOT, '--duration=60', '--log_rate=500',
                '--out=long'])
    expect(made.returncode == 0, 'a log', made)
    log = 'long/cut.csv'
    command = [ARMCAL, 'calibrate', ROBOT, f'--log={log}', '--quiet',
               '--out=cut']
    shutil.copy('long/log.csv', log)
    expect(run(command).returncode == 0, 'a calibration')
    whole = results('cut')
    shutil.rmtree('cut')
    counts = {0: 0, 3: 0}
    for k in range(4):
        shutil.copy('long/log.csv', log)
        size = os.path.getsize(log)
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        while not reads(process, log, size * (k + 1) // 6):
            pass
        os.truncate(log, size * (k + 1) // 8)
        error = process.communicate()[1]
        expect(process.returncode in counts, 'a refusal', error)
        counts[process.returncode] += 1
        if process.returncode == 0:
            found = results('cut')
            # They hold the log's hash, as it is in the end.
            for name in ('provenance.json', 'report.html'):
                found[name] = whole[name]
            expect(found == whole, 'a result of half a log')
        else:
            # It is read twice, first for what its positions have wrong: one
            # that is cut between is what it is then.
            expect('cut.csv: has changed while it was read' in error or
                   'cut.csv: row' in error and
                   'the file ends inside this row' in error,
                   'the reason', error)
            expect(not os.path.exists('cut'), 'a result of half a log')
        shutil.rmtree('cut', ignore_errors=True)
    print(f'4 logs cut while they were read: {counts[3]} refused')


def reads(process, path, least):
    """Whether the process has read so much of a file, or has ended."""
    folder = f'/proc/{process.pid}'
    try:
        for file in os.listdir(f'{folder}/fd'):
            if os.path.realpath(f'{folder}/fd/{file}') == os.path.abspath(path):
                with open(f'{folder}/fdinfo/{file}', encoding='ascii') as info:
                    return int(info.readline().split()[1]) >= least
    except OSError:
        pass
    return process.poll() is not None


def without_memory():
    """Each limit gives the results or one sentence."""
    if 'ASAN_OPTIONS' in os.environ:
        print('skipped: the sanitizer needs terabytes of addresses')
        return
    run(OLD)
    before, counts = results(), {}
    for megabytes in range(64, 112, 4):
        def limited(size=megabytes << 20):
            resource.setrlimit(resource.RLIMIT_AS, (size, size))

        finished = run(OLD, preexec_fn=limited)
        code = finished.returncode
        if code == 3:
            expect_refusal(finished, 'memory: the ', 'MB that are allowed '
                           '(ulimit -v) do not suffice')
        # 127: the system's loader has not even got armcal into memory; or a
        # library could not make its static objects, before main() says what
        # happens to exceptions; or libgfortran could not, which says so itself.
        before_main = code == 127 or (
            code == -signal.SIGABRT and 'terminate called' in finished.stderr) or (
            code == 1 and finished.stderr.startswith('Operating system error: ')
            and 'Memory allocation failed' in finished.stderr)
        expect(code in (0, 3) or before_main, f'{megabytes} MB', finished)
        expect(results() == before, f'the results with {megabytes} MB')
        counts[code] = counts.get(code, 0) + 1
    print('memory limits by exit code:', counts)
    expect(3 in counts, 'a limit at which memory does not suffice')


def paths():
    """Blanks and letters of any alphabet."""
    folder = 'Größe 腕 und\tMaß'
    os.mkdir(folder)
    shutil.copy(f'{DATA}/scara/robot.yaml', f'{folder}/mein Röböter.yaml')
    shutil.copy(f'{DATA}/scara/A.csv.gz', f'{folder}/Fahrt 1 α.csv.gz')
    made = run([ARMCAL, 'calibrate', f'--robot={folder}/mein Röböter.yaml',
                f'--log={folder}/Fahrt 1 α.csv.gz', '--joint_terms=none',
                f'--out={folder}/Ergebnis ∑'])
    expect(made.returncode == 0 and made.stderr == '', 'a calibration', made)
    run(OLD)
    expect(results(f'{folder}/Ergebnis ∑')['covariance.csv'] ==
           results()['covariance.csv'], 'the same covariance')


def locale():
    """Decimal commas of the environment, and of a program that has asked for
    them: numbers have points."""
    made = run(['localedef', '-i', 'de_DE', '-f', 'UTF-8', './de_DE.UTF-8'])
    if not os.path.isdir('de_DE.UTF-8'):
        print('skipped: a locale with decimal commas (install locales)', made)
        return
    german = dict(os.environ, LOCPATH=os.getcwd(), LC_ALL='de_DE.UTF-8')
    run(OLD)
    before = results()
    expect(run(OLD, env=german).returncode == 0, 'a calibration in German')
    expect(results() == before, 'the same results in German')
    if not MODULES:
        print('skipped: a Python program with decimal commas (-DPYTHON=ON)')
        return
    german['PYTHONPATH'] = MODULES
    # With decimal points first, then with commas.
    found = []
    for point, chosen in (('.', 'C'), (',', '')):
        made = run([sys.executable, '-B', '-c', f'''
import locale
locale.setlocale(locale.LC_ALL, {chosen!r})
assert locale.localeconv()['decimal_point'] == {point!r}
import armcal
armcal.calibrate({DATA + '/scara/robot.yaml'!r},
                 {DATA + '/scara/A.csv.gz'!r}, joint_terms='none', out='python')
'''], env=german)
        expect(made.returncode == 0, 'a calibration in Python', made)
        found.append(results('python'))
    for name, content in found[0].items():
        expect(found[1][name] == content, f'{name} of a German program')


def concurrent():
    """The results are those of one of the runs."""
    sets, _ = of_commands()
    for _ in range(3):
        together = [subprocess.Popen(command) for command in (OLD, NEW) * 3]
        for process in together:
            expect(process.wait() == 0, 'each of several runs must succeed')
        expect(results() in sets, 'several runs: half of one, half of another')
        expect_alone('several runs')


def other_libraries():
    """A zlib that says another version than armcal was compiled with."""
    run(OLD)
    before = results()
    for version, fits in (('1.1.4', False), ('2.0.0', False), ('1.99', True)):
        code = f'const char* zlibVersion(void) {{ return "{version}"; }}'
        made = run(['c++', '-x', 'c', '-shared', '-fPIC', '-o', './other.so',
                    '-'], input=code)
        expect(made.returncode == 0, 'a library', made)
        other = dict(os.environ, LD_PRELOAD=os.path.abspath('other.so'))
        finished = run(OLD, env=other)
        text = f"the library zlib: version: found '{version}': armcal was comp"
        if fits:
            expect(finished.returncode == 0, 'a newer library', finished)
        else:
            expect_refusal(finished, text)
        expect(results() == before, f'the results with zlib {version}')
        if MODULES:
            other['PYTHONPATH'] = MODULES
            imported = run([sys.executable, '-B', '-c', 'import armcal'],
                           env=other)
            expect(fits == (imported.returncode == 0) and
                   (fits or f'ImportError: {text}' in imported.stderr),
                   f'a Python program with zlib {version}', imported)


def kill_9():
    killed(signal.SIGKILL, KILLS)


def terminated():
    killed(signal.SIGTERM, KILLS // 3)


with tempfile.TemporaryDirectory() as empty:
    os.chdir(empty)
    for test in (kill_9, terminated, without_space, read_only,
                 log_cut_while_read, without_memory, paths, locale,
                 other_libraries, concurrent):
        shutil.rmtree('out', ignore_errors=True)
        begin = time.time()
        test()
        print(test.__name__, f'{time.time() - begin:.1f} s', flush=True)
