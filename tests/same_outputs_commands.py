"""The commands that same_outputs.py compares, and their small inputs.

Lines are run by bash in an empty folder in which `data` and `shared` are what
their names say, and `armcal` is the binary. What an earlier command left is
../NAME/..., an input below is a file there: both if they are named, be it in a
comment. The first line that fails is the last; its exit code has to be `code`.
Other codes than 0 before it are demanded by `exits CODE armcal ...`.
"""

import typing


class Command(typing.NamedTuple):
    name: str
    line: str
    code: int = 0


PRELUDE = r"""
exits() {  # exits CODE COMMAND...
  local wanted=$1 code=0
  shift
  "$@" || code=$?
  if [ $code != $wanted ]; then
    echo "exit code $code instead of $wanted: $*" >&2
    exit 99
  fi
}
column_times_minus_one() {  # of a log on stdin, by its name
  awk -F, -v OFS=, -v name=$1 'NR == 1 {
    for (i = 1; i <= NF; i++) if ($i == name) k = i } NR > 1 { $k *= -1 } 1'
}
scara="--robot=data/scara/robot.yaml"
exact="$scara --joint_terms=none --bandwidth=0"
urdf="--robot=data/six_axis/robot.urdf"
real="--robot=data/six_axis/real.yaml"
robots=shared/data
ur10e="--robot=$robots/ur10e_free/robot.urdf
  --torque_constants=14.87,13.26,11.13,10.62,11.03,11.47"
recorded="--robot_error=0.1 --log_rate=125"
constants="--torque_constants=11,11,11,8,8,8"
effects() {  # effects JOINT: NAME, or NAME@JOINT of those that are of a joint
  armcal simulate --list_effects | grep -o '^  [a-z_]*\(@JOINT\)\?$' |
    sed "s/JOINT/$1/"
}
effect_logs() {  # effect_logs PART OF: of every OFth effect, from the PARTth
  local run=0  # the arm has no room for a gyroscope
  effects 1 | grep -v gyroscope | sed -n $1~$2p | while read effect; do
    armcal simulate --robot=arm.yaml --robot_error=.02 --duration=12 --quiet \
      --log_rate=200 --run=$1$((++run)) --effects=$effect --temperature \
      --out=${effect%@1} --truth=truth/${effect%@1}
  done
}
diagnose_effects() {  # diagnose_effects FOLDER PART OF, of effect_logs
  for log in $(cd $1; ls */log.csv | sed -n $2~$3p); do
    armcal diagnose --robot=arm.yaml --forward=false --export=mjcf,sdf \
      --log=$1/$log --reference=../made/before/log.csv --out=${log%/*}
  done
}
"""

_ARM = """name: arm
gravity: [0, -9.81, 0]
convention: standard
links:
  - {joint: revolute, a: .4, mass: 5, com: [-.2, 0, 0], inertia: [.01, .07, .07],
     viscous: 2, coulomb: 3, armature: .3%s}
  - {joint: revolute, a: .3, mass: 3, com: [-.15, 0, 0], inertia: [.01, .03, .03],
     viscous: 1, coulomb: 2, armature: .2%s}
"""

INPUTS = {
    "arm.yaml": _ARM % (
        ", limits: {lower: -2, upper: 2, velocity: 2, effort: 100}",
        ", limits: {lower: -2.5, upper: 2.5, velocity: 3, effort: 50}"),
    "named.yaml": _ARM % (", name: '<b>upper</b>', joint_name: 'a,\"b\" مفصل'",
                          ", joint_name: elbow"),
    "drives.yaml": "rate: 1000\nbandwidth: 8\nfeedforward: none\n",
    "late.yaml": "rate: 1000\nbandwidth: 8\nfeedforward: none\ndelay: 0.004\n",
    "p.yaml": "law: p\nrate: 500\nbandwidth: 5\nlag: [.002, .001]\n",
    "cascade.yaml": "law: cascade\nposition_gain: [30, 30]\nkd: [200, 150]\n"
                    "velocity_ki: [4000, 3000]\nvelocity_limit: [2, 3]\n"
                    "delay: 0.004\nlag: [0.001, 0.001]\n",
    "integral.yaml": "bandwidth: 8\nki: [200, 100]\nfeedforward: gravity\n",
    "ringing.yaml": "kp: [1e9, 1e9]\nkd: [0, 0]\ndelay: 0.01\n"
                    "torque_limit: [1e12, 1e12]\nfeedforward: none\n",
    "massless.yaml": "convention: modified\nlinks:\n"
                     "  - {joint: revolute, a: .4, alpha: 1.5}\n",
    "bare.urdf": """<robot name="bare"><link name="base"/>
<link name="arm"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0"
iyy="1" iyz="0" izz="9"/></inertial></link>
<joint name="j" type="revolute"><parent link="base"/><child link="arm"/>
<axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="1"/>
</joint></robot>
""",
    "crane.yaml": """name: crane
convention: modified
links:
  - {joint: revolute, d: .3, mass: 10, com: [.02, 0, -.1], inertia: [.1, .1, .05],
     viscous: 2, coulomb: 3, armature: .2, unknown: [d],
     limits: {lower: -2, upper: 2, velocity: 2, effort: 80}}
  - {joint: prismatic, alpha: -1.5, a: .1, d: .2, mass: 4, com: [0, .03, .1],
     inertia: [.03, .001, .03, 0, 0, .02], viscous: 40, coulomb: 20, armature: 3,
     offset: 4, limits: {lower: .1, upper: .6, velocity: .6, effort: 300}}
  - {joint: revolute, alpha: 1.6, a: .05, theta: .3, mass: 2, com: [.1, 0, 0],
     inertia: [.004, .01, .01], viscous: .3, coulomb: .5, armature: .03,
     unknown: [a], limits: {lower: -2.5, upper: 2.5, velocity: 3, effort: 20}}
tool: {x: .05, z: .1, roll: .2}
""",
    "toy.xml": """<mujoco model="toy">
<compiler angle="degree" eulerseq="xyz" autolimits="true"/>
<option gravity="0 0 -9.8"/>
<default><joint damping="1" frictionloss=".5" armature=".1"/>
  <default class="wrist"><joint damping=".2"/></default></default>
<worldbody><body name="base"><geom type="box" size=".1 .1 .1"/>
  <body name="upper" pos="0 0 .3" euler="20 0 10">
    <joint name="a" axis="0 1 0" range="-90 90"/>
    <geom type="capsule" size=".04" fromto="0 0 0 0 0 .4" density="2000"/>
    <body name="fore" pos="0 0 .4" childclass="wrist">
      <joint name="b" axis="1 .2 0" range="-100 100" ref="10" pos="0 0 .01"/>
      <inertial pos="0 0 .1" mass="2" diaginertia=".02 .02 .005" quat=".9 .1 0 0"/>
      <body name="hand" pos="0 0 .3" axisangle="1 0 0 30">
        <joint name="c" type="slide" axis="0 0 1" range="-.1 .2" damping="30"/>
        <geom type="ellipsoid" size=".05 .04 .06" mass="1.5"/>
        <body name="tip" pos="0 0 .1"/></body></body></body></body></worldbody>
<actuator><motor joint="a" gear="2" ctrlrange="-40 40"/>
  <motor joint="b" gear="1" forcerange="-30 30"/>
  <motor joint="c" gear="1" ctrlrange="-90 90"/></actuator></mujoco>
""",
    "scara.flags": """# the SCARA arm that comes with armcal
--robot=data/scara/robot.yaml
--log=data/scara/B.csv.gz
--geometry=lengths
--joint-terms=none
--bandwidth=0
""",
    "wrong.flags": "--robot=a.yaml\n\n--lgo=a.csv\n",
    # NumPy's format, by the standard library: each column an array, no date.
    "npz.py": """import csv, struct, sys, zipfile
header, *rows = csv.reader(open(sys.argv[1]))
with zipfile.ZipFile(sys.argv[2], "w") as archive:
    for name, values in zip(header, zip(*rows)):
        text = repr({"descr": "<f8", "fortran_order": False, "shape": (len(rows),)})
        text = text.ljust(117) + chr(10)
        archive.writestr(zipfile.ZipInfo(name + ".npy"), bytes([147]) + b"NUMPY" +
                         struct.pack("<BBH", 1, 0, len(text)) + text.encode() +
                         struct.pack(f"<{len(rows)}d", *map(float, values)))
""",
}

COMMANDS = [
    # What armcal says of itself.
    Command("help", line=r"""
armcal help
armcal --help
armcal -h
for c in calibrate verify diagnose simulate excite inspect reduce merge compare watch; do
  armcal help $c
  armcal help $c --all
  armcal $c --help
  armcal $c --helpfull
done
"""),
    Command("manual", line="armcal help --man"),
    Command("version", line="armcal --version"),
    Command("nothing", code=2, line="armcal"),
    Command("completion", line=r"""
for s in bash zsh fish; do
  armcal completion $s
done
for line in '' 'ca' 'help ver' 'calibrate --' 'calibrate --geometry=' \
    'calibrate --joint_terms=viscous,co' 'diagnose --without=payl' \
    'excite --separate=' 'simulate --effects=' 'verify --robot=dat' \
    'inspect --export=' 'reduce --loss='; do
  armcal completion --line "armcal $line"
done
exits 2 armcal completion tcsh
"""),
    Command("list_effects", line=r"""
armcal simulate --list_effects
armcal simulate --list_effects --json
"""),
    # Wrong command lines and files.
    Command("wrong_flags", line=r"""
exits 2 armcal calibrat
exits 2 armcal frobnicate
exits 2 armcal help calibrat
exits 2 armcal calibrate
exits 2 armcal calibrate --lgo=a.csv
exits 2 armcal calibrate $scara
exits 2 armcal calibrate $scara more
exits 2 armcal diagnose --norobot
for flag in bandwidth=6Hz bandwidth=-1 interval=-2 window=0 crop=3:1 \
    intervals=0: gravity=0,0 solver=weigthed geometry=x joint_terms=stiction \
    joint_terms=viscous,viscous coulomb_width=2deg loss=lorentz trust=nan \
    estimate=best length_trust=0 trajectory=splined threads=-1 export=xml \
    quadrature=x identification=x torque_kind=x select=maybe; do
  exits 2 armcal calibrate $scara --log=data/scara/A.csv.gz --$flag --out=no
done
"""),
    Command("wrong_pairs", line=r"""
log=--log=data/scara/A.csv.gz
c='exits 2 armcal calibrate'
$c $scara $log $log
$c $scara $log,data/scara/A.csv.gz
$c $scara $log --validate=data/scara/A.csv.gz
$c $scara $log --payload_mass=2
$c $scara $log --torque_log=b.csv
$c $scara $log --trajectory=corrected --solver=batch
$c $scara $log --select --segment=0
$c $scara $log --geometry=refine --estimate=linear
$c --flagfile=wrong.flags
$c $scara --poses=p.csv --geometry=lengths
exits 2 armcal diagnose $scara $log --without=sorcery
exits 2 armcal inspect $scara --export=sdf
exits 2 armcal inspect $scara $log --fix
exits 2 armcal verify $scara --seed=x
exits 2 armcal merge $scara
exits 2 armcal reduce $scara $log --date=2026-02-31
exits 2 armcal excite $scara --target=friction
"""),
    Command("wrong_effects", line=r"""
for e in stribek@2 stribeck base_tilt@1 stribeck@3 stribeck@1:size=3 \
    payload:mass=heavy payload:mass=900kg payload:mass=3Nm; do
  exits 2 armcal simulate --robot=arm.yaml --out=no --effects=$e
done
for f in log_rate=300 duration=-1 size=2 torque_constants=0,1 step=1e-9 \
    joints=1,3 torque_noise=1,2,3; do
  exits 2 armcal simulate --robot=arm.yaml --out=no --$f
done
exits 3 armcal simulate --robot=arm.yaml --out=no --effects=payload:mass=50
exits 3 armcal simulate --robot=massless.yaml --out=no
"""),
    Command("no_such_file", code=3,
            line="armcal calibrate --robot=none.yaml --log=a.csv"),
    Command("broken_logs", line=r"""
zcat data/scara/A.csv.gz > whole.csv
sed 's/tau2/tua2/' whole.csv > no_tau2.csv
sed '7s/^[^,]*,[^,]*/0.01,zero/' whole.csv > word.csv
sed '9s/^[^,]*/-1/' whole.csv > backwards.csv
sed '9s/,[^,]*$//' whole.csv > short_row.csv
head -1 whole.csv > empty.csv
head -c 5000 data/scara/A.csv.gz > cut.csv.gz
rm whole.csv
for log in none.csv no_tau2.csv word.csv backwards.csv short_row.csv \
    empty.csv cut.csv.gz data; do
  for c in calibrate diagnose reduce; do
    exits 3 armcal $c $scara --log=$log --out=no
  done
done
rm *.csv *.gz
"""),
    Command("broken_robots", line=r"""
sed 's/mass: 20/mass: 2kg/' data/scara/robot.yaml > kg.yaml
sed 's/joint: revolute/joint: rotary/' data/scara/robot.yaml > rotary.yaml
sed 's/<axis xyz=.*/<axis xyz="0 0 0"\/>/' bare.urdf > axis.urdf
head -3 bare.urdf > cut.urdf
echo '<mujoco><worldbody/></mujoco>' > no.xml
for robot in kg.yaml rotary.yaml axis.urdf cut.urdf no.xml; do
  exits 3 armcal inspect --robot=$robot
done
exits 3 armcal inspect --robot=bare.urdf --tip=hand
"""),
    Command("no_room", line=r"""
exits 3 armcal --help > /dev/full
exits 3 armcal verify $scara --out=/proc/x
exits 3 armcal inspect $scara --json > /dev/full
exits 3 armcal calibrate $scara --log=data/scara/A.csv.gz --bandwidth=1e-9
"""),
    # Simulated logs, of which others are made; sensors, motions, drives.
    Command("made", line=r"""
armcal simulate --robot=arm.yaml --duration=20 --log_rate=100 \
    --robot_error=0.02 --run=1 --out=before --truth=truth
armcal simulate --robot=arm.yaml --duration=20 --log_rate=100 \
    --robot_error=0.02 --run=2 --effects=payload:mass=0.5kg --out=after
for run in 3 4; do
  armcal simulate --robot=arm.yaml --duration=20 --robot_error=0.02 \
      --run=$run --effects=torque_ripple@2:amplitude=.1 --json \
      --out=rippled$run
done
"""),
    Command("six_axis_logs", line=r"""
armcal simulate $real $recorded --run=1 --duration=10 --out=monday
armcal simulate $real $recorded --run=2 --motion=points --duration=8 \
    --out=check
armcal simulate $real $recorded --run=3 --duration=10 \
    '--effects=encoder_offset@forearm_joint:offset=0.02rad;stribeck@2' \
    --out=friday
armcal simulate $real $recorded --run=4 $constants --duration=10 --out=bare
armcal simulate $real $recorded --run=5 $constants --duration=10 \
    --out=loaded --effects=payload:mass=2.5kg,com_x=0.1m,com_y=0m,com_z=0m
"""),
    Command("commanded_logs", line=r"""
for run in 1 2; do
  armcal simulate $scara --run=$run --robot_error=.2 --controller=late.yaml \
      --encoder_noise=5e-5 --duration=8 --effects= --out=log$run \
      --truth=hidden
done
cut -d, -f1-5,14-17 log1/log.csv > commands.csv
head -1 commands.csv
"""),
    Command("all_effects", line=r"""
effects 2 | while read effect; do
  armcal simulate $real --duration=1 --log_rate=100 --effects=$effect --json \
      --out=${effect%@2}
done
"""),
    Command("sensors", line=r"""
armcal simulate --robot=arm.yaml --duration=5 --seed=7 --run=2 \
    --encoder_resolution=1e-4,1e-3 --encoder_noise=1e-5 \
    --torque_noise=.02,.01 --coloured_noise=0.01 --noise_correlation=.1 \
    --torque_delay=.004 --jitter=.0005 --lost=.01 --temperature \
    --torque_constants=2,3 --friction_width=.02 --step=.0005 --out=noisy
exits 3 armcal simulate $urdf --duration=3 --out=no
armcal simulate $real --duration=3 --size=.3 --speed=.5 --joints=5,6 \
    --standstill=.5 --gravity=0,0,-9 --log_rate=500 --quiet --out=slow
"""),
    Command("drives", line=r"""
for law in p cascade integral; do
  armcal simulate --robot=arm.yaml --motion=points --duration=4 \
      --controller=$law.yaml --out=$law
done
armcal simulate --robot=arm.yaml --motion=p/log.csv --out=again
armcal simulate --robot=arm.yaml --duration=15 --run=2 --out=payload \
    --controller=integral.yaml --effects=payload:mass=1kg
# controllers: p.yaml cascade.yaml integral.yaml
"""),
    Command("effect_logs_1", line="effect_logs 1 2  # arm.yaml"),
    Command("effect_logs_2", line="effect_logs 2 2  # arm.yaml"),
    Command("unstable_drive", code=1, line=r"""
armcal simulate --robot=arm.yaml --duration=2 --controller=ringing.yaml \
    --out=out
"""),
    # inspect: robot files.
    Command("inspect_robots", line=r"""
exits 1 armcal inspect $scara
armcal inspect $urdf
exits 1 armcal inspect --robot=bare.urdf
for r in 0,tx40 0,kr300 0,ur10e_free 1,panda; do
  exits ${r%,*} armcal inspect --json --robot=$robots/${r#*,}/robot.urdf \
      --out=${r#*,}
done
armcal inspect $urdf --base=shoulder --tip=wrist_2
"""),
    Command("inspect_export", line=r"""
armcal inspect $real --export=urdf,mjcf,sdf,yaml --out=six
exits 1 armcal inspect $scara --export=yaml,mjcf --out=scara
armcal inspect --robot=arm.yaml --controller=cascade.yaml --export=mjcf \
    --out=cascade
armcal inspect --robot=arm.yaml --controller=p.yaml --export=mjcf --out=p
for f in six/robot.urdf six/robot.xml six/robot.yaml; do
  armcal inspect --robot=$f --export=yaml --out=again/$f
done
"""),
    # Other conventions: a modified DH table, and MJCF, by all commands.
    Command("crane", line=r"""
armcal simulate --robot=crane.yaml --duration=15 --log_rate=200 --out=log
for g in lengths all_lengths refine; do
  armcal calibrate --robot=crane.yaml --log=log/log.csv --geometry=$g \
      --out=$g --export=mjcf,sdf,yaml
done
armcal verify --robot=crane.yaml --calibration=refine/calibration.json \
    --log=log/log.csv --crop=0:4 --controller=late.yaml --out=verified
armcal diagnose --robot=crane.yaml --log=log/log.csv --export=mjcf,sdf,yaml \
    --out=diagnosed
"""),
    Command("mjcf", line=r"""
armcal inspect --robot=toy.xml --export=urdf,mjcf,sdf,yaml --out=e
armcal simulate --robot=toy.xml --duration=15 --log_rate=200 --out=log
for robot in toy.xml e/robot.yaml e/robot.urdf; do
  armcal calibrate --robot=$robot --log=log/log.csv --out=of/$robot
done
armcal verify --robot=toy.xml --log=log/log.csv --crop=0:4
"""),
    # inspect: logs.
    Command("inspect_log", line=r"""
armcal inspect --robot=arm.yaml \
    --log=../made/before/log.csv,../made/after/log.csv --out=out
"""),
    Command("inspect_fix", line=r"""
column_times_minus_one tau2 < ../made/before/log.csv > wrong.csv
exits 1 armcal inspect --robot=arm.yaml --log=wrong.csv --fix --out=out
armcal inspect --robot=arm.yaml --log=out/fixed_1.csv --json
"""),
    Command("inspect_commands", line=r"""
cut -d, -f1-3,8-9 ../made/before/log.csv > c.csv
head -1 c.csv
armcal inspect --robot=arm.yaml --log=c.csv --quiet --out=out
"""),
    Command("inspect_real_logs", line=r"""
for log in 0,tx40/log.csv.gz 1,panda_set2/log.csv.gz 1,dvrk_psm/log_A.csv.gz \
    1,kr300/log_A.csv.gz 1,schunk_lwa4p/run_081.csv.gz \
    1,dfki_simple_pendulum/handguided.csv \
    1,innopolis_pendubot/position_A_1p2_v_0p3.csv; do
  set=${log#*,}
  set=${set%/*}
  exits ${log%,*} armcal inspect --robot=$robots/$set/robot.urdf \
      --log=$robots/${log#*,} --out=$set
done
"""),
    Command("inspect_currents", code=1, line=r"""
armcal inspect $ur10e --torque_kind=current \
    --log=$robots/ur10e_free/id_20s.csv,$robots/ur10e_free/sweep_joint3.csv \
    --fix --out=out
"""),
    Command("inspect_bags", line=r"""
mkdir f
tar xJf data/log_formats/written.tar.xz -C f
i='armcal inspect --robot=arm.yaml'
exits 3 $i --log=f/log.db3 --topics=/states
for log in nan_effort empty_effort one_nan short_message odd_type json \
    no_stamps long_names two_arms; do
  exits 3 $i --log=f/$log.mcap
done
exits 1 $i --log=f/halves.mcap
exits 1 $i --log=f/two_arms.mcap --topics=/joint_states
rm -r f
"""),
    # calibrate: equations, solvers, geometry, on exact logs.
    Command("lengths", line=r"""
armcal calibrate $exact --geometry=lengths --log=data/scara/B.csv.gz \
    --validate=data/scara/A.csv.gz --export=urdf,mjcf,sdf,yaml --out=out
"""),
    Command("all_lengths", line=r"""
armcal calibrate $exact --geometry=all_lengths \
    --log=data/scara/B.csv.gz,data/scara/C.csv.gz --estimate=refined \
    --out=out
armcal calibrate $scara --log=data/scara/B.csv.gz --crop=0:0.5 \
    --geometry=all_lengths
"""),
    Command("integral", line=r"""
for solver in batch recursive weighted; do
  for q in trapezoid simpson; do
    armcal calibrate $exact --geometry=lengths --log=data/scara/A.csv.gz \
        --identification=integral --intervals=0:0.5,0.5:1,1:1.5 \
        --quadrature=$q --solver=$solver --out=$solver-$q
  done
done
armcal calibrate $scara --log=data/scara/B.csv.gz --identification=integral \
    --interval=.25 --json
"""),
    Command("recursive_refused", code=1, line=r"""
armcal calibrate $exact --geometry=lengths --log=data/scara/A.csv.gz \
    --identification=integral --solver=recursive \
    --intervals=1:1.5,1.5:2,2.5:3 --out=out
"""),
    Command("differential", line=r"""
for solver in weighted batch recursive; do
  armcal calibrate $exact --identification=differential --solver=$solver \
      --log=data/scara/B.csv.gz --out=$solver
done
exits 1 armcal calibrate $exact --identification=differential \
    --estimate=refined --log=data/scara/B.csv.gz
"""),
    Command("weak", line=r"""
armcal calibrate $scara --log=data/scara/B.csv.gz --window=.5 --bandwidth=12 \
    --joint_terms=viscous,armature --estimate=linear --out=one
armcal calibrate $scara --log=data/scara/B.csv.gz --solver=batch \
    --joint_terms=coulomb,offset --coulomb_width=0.02rad/s --out=two
armcal calibrate $scara --log=data/scara/B.csv.gz --coulomb_width=0.001rad \
    --gravity=0,0,9.7 --threads=1 --out=three
"""),
    Command("losses", line=r"""
zcat data/scara/B.csv.gz | awk -F, -v OFS=, '
  NR > 1 {
    for (i = 1; i <= 4; ++i)
      $(13 + i) += .1 * sin(97 * NR * i) * cos(31 * NR * NR)
  }
  NR > 300 && NR % 100 == 1 && NR < 850 { $15 += 3 } 1' > spoiled.csv
for loss in auto huber cauchy tukey squared; do
  armcal calibrate $scara --log=spoiled.csv --loss=$loss --out=$loss
done
"""),
    Command("flag_file", line=r"""
armcal calibrate --flagfile=scara.flags --json --out=out
armcal calibrate --flagfile=scara.flags --joint_terms=viscous --quiet
"""),
    Command("worthless_logs", line=r"""
for p in '$4 = 0.1; $8 = $12 = 0; $16 = -30.478' \
    'for (i = 14; i <= 17; ++i) $i = (NR % 7 > 3 ? -1 : 1) * 1e200' \
    'for (i = 14; i <= 17; ++i) $i = 0' 'for (i = 2; i < 14; ++i) $i = .3'; do
  zcat data/scara/B.csv.gz | awk -F, -v OFS=, "NR > 1 { $p } 1" > log.csv
  exits 1 armcal calibrate $scara --log=log.csv --out=out
done
"""),
    Command("refined_geometry", line=r"""
armcal calibrate $scara --log=data/scara/B.csv.gz \
    --poses=data/scara/poses.csv --geometry=refine --out=both
armcal calibrate --robot=arm.yaml --log=../made/before/log.csv \
    --geometry=refine --length_trust=.005 --angle_trust=.01 --out=refine
armcal calibrate --robot=arm.yaml --log=../made/before/log.csv \
    --geometry=offsets --out=zeros
"""),
    Command("corrected", line=r"""
armcal calibrate $scara --geometry=lengths --joint_terms=none \
    --log=data/scara/B.csv.gz --validate=data/scara/A.csv.gz \
    --trajectory=corrected --out=exact
armcal calibrate --robot=arm.yaml --log=../made/before/log.csv \
    --trajectory=corrected --out=noisy
"""),
    Command("six_axis_geometry", line=r"""
log=--log=../six_axis_logs/monday/log.csv
armcal calibrate $urdf $log --geometry=refine --trust=.3 --out=refine
armcal calibrate $urdf $log --geometry=lengths --estimate=linear \
    --out=lengths
armcal calibrate --robot=../inspect_export/six/robot.xml $log \
    --torque_kind=link --out=mjcf
"""),
    # calibrate: simulated logs with noise and friction.
    Command("six_axis", line=r"""
armcal calibrate $urdf --log=../six_axis_logs/monday/log.csv \
    --validate=../six_axis_logs/check/log.csv --trust=.3 --export=mjcf,yaml \
    --out=out
"""),
    Command("select", line=r"""
armcal calibrate --robot=arm.yaml \
    --log=../made/before/log.csv,../made/rippled3/log.csv --select \
    --segment=3 --out=out
"""),
    Command("crops", line=r"""
armcal calibrate --robot=arm.yaml --log=../made/before/log.csv --crop=0:12 \
    --validate=../made/before/log.csv --validate_crop=12:22 --out=out
"""),
    Command("names", line=r"""
armcal simulate --robot=named.yaml --duration=10 --log_rate=100 --out=log
armcal calibrate --robot=named.yaml --log=log/log.csv \
    --export=urdf,mjcf,sdf,yaml --out=out
"""),
    Command("payload", line=r"""
armcal calibrate $urdf --log=../six_axis_logs/bare/log.csv \
    --payload_mass=2.5 --payload_log=../six_axis_logs/loaded/log.csv \
    --out=out
exits 3 armcal calibrate $urdf --log=../six_axis_logs/bare/log.csv
"""),
    Command("torque_kinds", line=r"""
armcal calibrate $urdf --log=../six_axis_logs/bare/log.csv \
    --torque_constants=1.1,1.1,1.1,0.8,0.8,0.8 --estimate=linear \
    --gear_ratios=10,10,10,10,10,10 --torque_kind=current --out=out
armcal calibrate --robot=arm.yaml --log=../made/before/log.csv \
    --torque_kind=motor --gear_ratios=2,3 --trust=3 --out=motor
armcal reduce --robot=arm.yaml --log=../made/before/log.csv \
    --torque_kind=command --out=command
"""),
    Command("commanded", line=r"""
armcal calibrate $scara --controller=drives.yaml --trust=.2 \
    --log=../commanded_logs/log1/log.csv --crop=0:5 --out=out \
    --validate=../commanded_logs/log2/log.csv --export=mjcf
"""),
    Command("commanded_gains", line=r"""
armcal calibrate $scara --controller=drives.yaml \
    --log=../commanded_logs/log1/log.csv --crop=0:4 --gains_trust=.1 \
    --delay_trust=0 --joint_terms=viscous --trust=.2 --out=out
"""),
    Command("commanded_with_torques", line=r"""
armcal calibrate $scara --controller=drives.yaml \
    --log=../commanded_logs/log1/log.csv --crop=0:4 --trust=.2 --out=out \
    --torque_log=../commanded_logs/log2/log.csv
"""),
    Command("formats", line=r"""
mkdir f
tar xJf data/log_formats/written.tar.xz -C f
cp data/log_formats/log.csv f
python3 npz.py f/log.csv f/log.npz
for log in log.csv log.npz log.db3 zstd.mcap lz4.mcap plain.mcap \
    big_endian.mcap split v4.mat v5.mat v73.mat; do
  armcal calibrate --robot=arm.yaml --log=f/$log --out=out/$log
done
armcal calibrate --robot=arm.yaml --log=f/two_topics.mcap \
    --topics=effort:/torques
exits 1 armcal calibrate --robot=arm.yaml --log=f/packed
rm -r f
"""),
    # calibrate: poses.
    Command("poses", line=r"""
for loss in auto huber cauchy tukey squared; do
  armcal calibrate $scara --poses=data/scara/poses.csv --geometry=refine \
      --loss=$loss --out=$loss
done
for g in known offsets; do
  armcal calibrate $scara --poses=data/scara/poses.csv --geometry=$g \
      --export=mjcf --out=$g
done
"""),
    Command("whole_poses", line=r"""
awk 'BEGIN {
  print "q1,q2,x [mm],y [mm],z [mm],qw,qx,qy,qz"
  for (k = 0; k < 12; ++k) {
    a = sin(k)
    b = a + cos(2 * k)
    printf "%.9f,%.9f,%.6f,%.6f,0,%.9f,0,0,%.9f\n", a, b - a,
        402 * cos(a) + 300 * cos(b), 402 * sin(a) + 300 * sin(b),
        cos(b / 2), sin(b / 2)
  }
}' > poses.csv
armcal calibrate --robot=arm.yaml --poses=poses.csv --geometry=refine --out=out
"""),
    Command("fanuc_poses", line=r"""
armcal calibrate --robot=$robots/geo_fanuc_r2000/robot.urdf \
    --poses=$robots/geo_fanuc_r2000/poses.csv --geometry=refine --out=fanuc
armcal calibrate --robot=$robots/geo_fanuc_set2/robot.urdf \
    --poses=$robots/geo_fanuc_set2/poses.csv --geometry=offsets \
    --out=coupled
"""),
    Command("wire_poses", line=r"""
head -400 $robots/geo_irb120_cable/poses.csv > poses.csv
armcal calibrate --robot=$robots/geo_irb120_cable/robot.urdf \
    --poses=poses.csv --geometry=refine --length_trust=.002 --out=out
"""),
    Command("motoman_poses", code=1, line=r"""
armcal calibrate --robot=$robots/geo_motoman/robot.urdf \
    --poses=$robots/geo_motoman/poses.csv.gz --geometry=refine --out=out
"""),
    # calibrate: logs of real robots.
    Command("ur10e", line=r"""
armcal calibrate $ur10e --bandwidth=6 --crop=3:22 --out=out \
    --log=$robots/ur10e_free/id_20s.csv --validate_crop=7:25 \
    --validate=$robots/ur10e_free/val_ptp.csv
"""),
    Command("panda", line=r"""
armcal calibrate --robot=$robots/panda/robot.urdf --bandwidth=8 \
    --log=$robots/panda/log.csv --out=out
"""),
    Command("double_pendulum", line=r"""
d=$robots/dfki_double_pendulum
armcal calibrate --robot=$d/robot_A.urdf --bandwidth=5 \
    --validate=$d/A0_sysid_04.csv \
    --log=$d/A0_sysid_01.csv,$d/A0_sysid_02.csv,$d/A0_sysid_03.csv --out=out
"""),
    Command("pendubot", line=r"""
d=$robots/innopolis_pendubot/position_A_1p2_v_
armcal calibrate --robot=$robots/innopolis_pendubot/robot.urdf --bandwidth=5 \
    --log=${d}0p01.csv,${d}0p1.csv,${d}0p2.csv,${d}0p3.csv \
    --validate=${d}0p4.csv --out=out
"""),
    Command("tx40", line=r"""
armcal calibrate --robot=$robots/tx40/robot.urdf --bandwidth=40 \
    --log=$robots/tx40/log.csv.gz --crop=0:5 --identification=differential \
    --out=out
"""),
    Command("kr300", line=r"""
armcal calibrate --robot=$robots/kr300/robot.urdf --trust=.05 \
    --log=$robots/kr300/log_A.csv.gz,$robots/kr300/log_B.csv.gz \
    --validate=$robots/kr300/log_C.csv.gz --export=sdf --out=out
"""),
    # verify
    Command("verify", line=r"""
armcal verify $scara --seed=5 --out=alone
armcal verify $scara --log=data/scara/A.csv.gz --out=log
exits 1 armcal verify --robot=bare.urdf --json
"""),
    Command("verify_calibration", line=r"""
armcal verify $urdf --out=out --crop=0:3 \
    --calibration=../six_axis/out/calibration.json \
    --log=../six_axis_logs/check/log.csv --bandwidth=10
exits 3 armcal verify $scara --calibration=../six_axis/out/calibration.json
"""),
    Command("verify_loop", line=r"""
armcal verify --robot=arm.yaml --controller=integral.yaml \
    --log=../drives/integral/log.csv --out=out
armcal verify --robot=arm.yaml --controller=p.yaml --log=../drives/p/log.csv \
    --crop=1:3
"""),
    Command("verify_panda", line=r"""
armcal verify --robot=$robots/panda/robot.urdf --out=out \
    --log=$robots/panda/log.csv --crop=2:5
"""),
    # diagnose
    Command("diagnose_reference", line=r"""
armcal diagnose --robot=arm.yaml --log=../made/after/log.csv \
    --reference=../made/before/log.csv --export=mjcf,sdf,yaml --out=out
"""),
    Command("diagnose_validate", line=r"""
armcal diagnose --robot=arm.yaml --out=out --log=../made/rippled3/log.csv \
    --validate=../made/rippled4/log.csv
"""),
    Command("diagnose_without", line=r"""
armcal diagnose --robot=arm.yaml --forward=false \
    --log=../made/rippled3/log.csv --without=torque_ripple,position_friction \
    --trust=.1 --seed=3 --json --out=out
"""),
    Command("diagnose_commands", line=r"""
armcal diagnose --robot=arm.yaml --trust=.02 --controller=integral.yaml \
    --log=../drives/payload/log.csv --out=out
cut -d, -f1-3,8-9 ../drives/payload/log.csv > c.csv
head -1 c.csv
armcal diagnose --robot=arm.yaml --trust=.02 --controller=integral.yaml \
    --log=c.csv --crop=0:11 --validate=c.csv --validate_crop=11:17 \
    --out=alone
"""),
    Command("diagnose_commands_alone", line=r"""
armcal diagnose $scara --controller=late.yaml \
    --log=../commanded_logs/commands.csv --forward=false --out=out
"""),
    Command("diagnose_six_axis", line=r"""
armcal diagnose $urdf --bandwidth=10 --forward=false \
    --reference=../six_axis_logs/monday/log.csv \
    --log=../six_axis_logs/friday/log.csv --out=out
"""),
    Command("diagnose_not_testable", code=1, line=r"""
armcal diagnose --out=out --robot=$robots/dfki_simple_pendulum/robot.urdf \
    --log=$robots/dfki_simple_pendulum/handguided.csv --crop=0:12
"""),
    Command("diagnose_pendulum", line=r"""
armcal diagnose --out=out --robot=$robots/dfki_simple_pendulum/robot.urdf \
    --log=$robots/dfki_simple_pendulum/energy_ref.csv \
    --reference=$robots/dfki_simple_pendulum/swing_A.csv
"""),
    Command("diagnose_push", line=r"""
d=$robots/dfki_acrobot
armcal diagnose --forward=false --robot=$d/robot.urdf --log=$d/run_01.csv.gz \
    --out=out --reference=$d/reference_01.csv.gz,$d/reference_02.csv.gz
"""),
    Command("diagnose_weight", line=r"""
d=$robots/dvrk_psm
armcal diagnose --forward=false --robot=$d/robot.urdf --log=$d/log_A.csv.gz \
    --crop=0:15 --out=out --reference=$d/reference.csv.gz
"""),
    Command("diagnose_series", line=r"""
d=$robots/schunk_lwa4p
armcal diagnose --forward=false --robot=$d/robot.urdf --trust=.5 \
    --bandwidth=30 --out=out \
    --log=$d/run_080.csv.gz,$d/run_084.csv.gz,$d/run_088.csv.gz,$d/run_092.csv.gz
"""),
    Command("diagnose_coupled", line=r"""
armcal diagnose --robot=$robots/tx40/robot.urdf \
    --log=$robots/tx40/log.csv.gz --crop=0:5 --forward=false --trust=.5 \
    --bandwidth=20 --out=out
"""),
    Command("diagnose_contact", line=r"""
armcal diagnose $ur10e --forward=false --out=out \
    --log=$robots/ur10e_free/push_contact_1.csv \
    --reference=$robots/ur10e_free/id_20s.csv
"""),
    Command("diagnose_heavy", line=r"""
d=$robots/kr300
armcal diagnose --robot=$d/robot.urdf --log=$d/log_A.csv.gz,$d/log_B.csv.gz \
    --validate=$d/log_C.csv.gz --out=out
"""),
    Command("diagnose_panda", line=r"""
awk 'NR % 4 == 1' $robots/panda/log.csv > log.csv
armcal diagnose --robot=$robots/panda/robot.urdf --trust=1 --log=log.csv \
    --bandwidth=8 --forward=false --out=out
exits 3 armcal diagnose --robot=$robots/panda/robot.urdf --log=log.csv \
    --crop=0:7
"""),
    Command("diagnose_effects_11",
            line="diagnose_effects ../effect_logs_1 1 2  # arm.yaml ../made"),
    Command("diagnose_effects_12",
            line="diagnose_effects ../effect_logs_1 2 2  # arm.yaml ../made"),
    Command("diagnose_effects_21",
            line="diagnose_effects ../effect_logs_2 1 2  # arm.yaml ../made"),
    Command("diagnose_effects_22",
            line="diagnose_effects ../effect_logs_2 2 2  # arm.yaml ../made"),
    # excite
    Command("excite", line=r"""
armcal excite --robot=arm.yaml --duration=8 --out=out
armcal simulate --robot=arm.yaml --motion=out/trajectory.csv --out=played
"""),
    Command("excite_workspace", line=r"""
armcal excite --robot=arm.yaml --duration=5 --floor=-.45 --link_radius=.04 \
    --out=floor
armcal excite --robot=arm.yaml --duration=5 \
    --obstacles='0.4:0.6,-1:-.6,0:0.5;-1:-.8,-1:1,-1:1' \
    --tool_box=-.6:.8,-.6:.8,-1:1 --harmonics=3 --periods=2 --use=.8 \
    --out=box
exits 3 armcal excite --robot=arm.yaml --tool_box=5:6,5:6,5:6
exits 1 armcal excite --robot=arm.yaml --effort_limits=.01
"""),
    Command("excite_targets", line=r"""
for t in physical geometry; do
  for c in A worst; do
    armcal excite --robot=arm.yaml --duration=4 --target=$t --criterion=$c \
        --trust=.3 --position_limits=-1:1 --velocity_limits=2,3 \
        --acceleration_limits=8 --torque_noise=.02 --seed=3 --out=$t-$c
  done
done
"""),
    Command("excite_separate", line=r"""
armcal excite --robot=arm.yaml --duration=4 --harmonics=2 \
    --separate=elasticity,delay --out=out
"""),
    Command("excite_given", line=r"""
armcal simulate --robot=arm.yaml --duration=10 --joints=1 --out=poor
exits 1 armcal calibrate --robot=arm.yaml --log=poor/log.csv --out=known
armcal excite --robot=arm.yaml --given=poor/log.csv --duration=5 \
    --criterion=worst --out=log
armcal excite --robot=arm.yaml --given=known/calibration.json --duration=5 \
    --json --out=calibration
"""),
    Command("excite_six_axis", line=r"""
armcal excite $urdf --duration=5 --harmonics=2 --floor=-.1 --out=out
"""),
    Command("postures", line=r"""
armcal excite $urdf --static_poses=10 --out=target
armcal excite $scara --static_poses=8 --instrument=pose \
    --pose_noise=1e-4,2e-4 --length_trust=.005 --out=pose
"""),
    # reduce, merge
    Command("reduce", line=r"""
model='--bandwidth=8 --geometry=lengths --joint_terms=none --loss=squared'
for log in A B C; do
  armcal reduce $scara $model --log=data/scara/$log.csv.gz --out=factors
done
armcal reduce $scara --log=data/scara/C.csv.gz --like=$(ls factors/A*) \
    --json --out=like
armcal reduce $scara --log=data/scara/B.csv.gz --identification=integral \
    --interval=.2 --quadrature=simpson --bandwidth=9 --out=nine
"""),
    Command("merge", line=r"""
f=../reduce/factors
armcal merge $scara --factors=$f --out=all
armcal merge $scara --factors=$(ls $f/C*),$(ls $f/A*) --quiet --out=two
armcal merge $scara --factors=$(ls $f/B*),two/merged.factor --json \
    --out=again
exits 3 armcal merge $scara --factors=$f,$f --out=no
exits 3 armcal merge $scara --factors=$f,../reduce/nine --out=no
exits 3 armcal merge --robot=arm.yaml --factors=$f --out=no
"""),
    Command("fleet", line=r"""
like=
for unit in 1 2 3 4 5 6 7; do
  armcal simulate --robot=arm.yaml --robot_error=0.05 --seed=$unit \
      --duration=8 --log_rate=100 --quiet --out=unit$unit
  armcal reduce --robot=arm.yaml $like --unit=$unit --log=unit$unit/log.csv \
      --date=2026-03-0$unit --out=factors
  like=--like=$(ls factors/* | head -1)
done
armcal merge --robot=arm.yaml --factors=factors --out=fleet
"""),
    Command("fleet_of_runs", line=r"""
d=$robots/schunk_lwa4p
like=
for run in 1 5 9 13 17; do
  run=$(printf %03d $run)
  armcal reduce --robot=$d/robot.urdf $like --unit=$((10#$run % 5)) \
      --log=$d/run_$run.csv.gz --out=factors
  like=--like=$(ls factors/* | head -1)
done
armcal merge --robot=$d/robot.urdf --factors=factors --out=fleet
"""),
]
