# The rooms of the house, one folder each, in the order in which data flows: a
# room may include itself and those above it. CMakeLists.txt builds each layer
# from its rooms and tests/layering_test.py holds the includes to the order.
set(rooms
    model/text          # numbers, times, archives and XML out of bytes
    model/camera        # what a lens makes of points, and files of it
    model/robot         # the arm as a value: links, joints, frames, inertias
    model/ros_bags      # messages out of rosbag2's files
    model/log_files/columns  # which column of a header holds what
    model/log_files     # logs and poses out of CSV, bags, NumPy and MATLAB files
    model/simd/lanes      # arithmetic on several numbers at once, filters
    model/simd/regressor  # torques and columns of many samples of one arm
    model/simd/motion     # the motion of many arms
    model/simd          # the kernels, one table for each instruction set
    model/signals       # filtered, resampled, differentiated motion
    model/dynamics      # torques of motions, regressors, drives, forward dynamics
    model/robot_tree    # links and joints of a file, the chain chosen from them
    model/robot_files/mjcf  # MJCF in, as MuJoCo reads it
    model/robot_files   # URDF, MJCF, SDF, YAML in and out
    model/effects       # what rigid bodies lack: what a law is, and their list
    model/effects/friction   # one law a file, here and in the next three
    model/effects/drive
    model/effects/arm
    model/effects/recording
    model/plant         # Simbody, the engine that shares no code with ours
    model/plant/hidden  # effects in laws of their own, for blind tests
    problems            # unknowns, measurements, equations
    problems/poses      # the same of measured poses: one kind of instrument a file
    calib/numerics      # factors, posteriors, spectra, bootstraps
    calib/logs          # passes over sets of logs and what is left after a fit
    calib/linear        # model parameters by linear least squares
    calib/poses         # geometry from measured poses
    calib/poses/cameras # poses of the tool in images of a board
    calib/poses/effects    # what geometry lacks: one effect a file, their list
    calib/poses/effects/order  # of these, what acts over the order of poses
    calib/poses/diagnosis  # which of these a campaign of measured poses shows
    calib/poses/correction # what a controller adds to its joints' positions
    calib/refine        # the refinement by Ceres and its covariance
    calib/excite        # motions that show what is not known yet
    calib/closed_loop   # estimation from commands and positions alone
    calib/drive_gains   # torque constants from logs with a known load
    calib/fleet         # many logs and robots by their factor files
    calib/verify        # the estimate against Simbody
    calib/force_torque  # what a force-torque sensor on the arm carries
    calib/drive_trains  # what lies between motor currents and torque sensors
    calib/diagnose/data        # what a diagnosis is made from
    calib/diagnose/changes     # which parameters changed from log to log
    calib/diagnose/candidates  # effects that could explain a gap
    calib/diagnose/modules     # what was found as sources for simulators' loops
    calib/diagnose/contacts    # what touches are in what a model leaves
    calib/diagnose/select      # which of them do
    calib/diagnose/judge       # what held-out data say of them
    calib/diagnose      # the diagnosis as a whole and its files
    calib/inspect/columns # what a column shows without a model of the arm
    calib/inspect       # what a log or robot file holds and what is wrong
    calib/compare       # whether results of one robot agree within noise
    calib/watch         # a running log against a calibration, sample by sample
    calib               # the doors: one header for each command
    tools/report        # the page report.html
    tools               # what commands share: flags, help, what is printed
    tools/commands      # one command a file, with its flags
    tools/program       # armcal: the list of commands, main()
    tools/python)       # the Python module

# Rooms above a room that it may not use all the same.
set(not_from_problems model/plant model/plant/hidden)
foreach(room ${rooms})
  if(room MATCHES "^(calib|tools)")
    set(not_from_${room} model/plant/hidden)
  endif()
endforeach()
set(not_from_tools/python "")
# The truth of blind tests, which only the simulation may know.
set(sees_hidden "^tools/commands/simulate")

# The layers, each a library: `rooms_LAYER` are the folders it is made of.
set(layers model effects plant hidden problems calib)
foreach(room ${rooms})
  if(room MATCHES "^model/.*(effects|plant|hidden)")
    set(layer ${CMAKE_MATCH_1})
  else()
    string(REGEX REPLACE "/.*" "" layer ${room})
  endif()
  list(APPEND rooms_${layer} ${room})
endforeach()
