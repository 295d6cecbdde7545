#include "tests/fuzz/fuzzed_readers.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "calib/fleet/factor_file.h"
#include "calib/numerics/sha256.h"
#include "calib/refine/calibration_reader.h"
#include "calib/refine/given_calibration.h"
#include "calib/refine/parameter_posterior.h"
#include "model/log_files/log_reader.h"
#include "model/log_files/pose_reader.h"
#include "model/robot_files/controller_reader.h"
#include "model/robot_files/robot_reader.h"
#include "model/ros_bags/bag_folder.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

// The robot that logs, calibrations and controllers are read for.
const Robot& FuzzedRobot() {
  static const Robot robot = ReadRobot(FUZZ_DIR "/arm.yaml", {});
  return robot;
}

std::string BytesOf(const std::string& path) {
  std::ostringstream file;
  file << std::ifstream(path, std::ios::binary).rdbuf();
  return file.str();
}

LogReaderOptions AllSignals() {
  LogReaderOptions options;
  options.joint_names = FuzzedRobot().JointNames();
  options.want_velocity = options.want_acceleration = true;
  options.want_reference = options.want_temperature = true;
  return options;
}

void ReadLog(const std::string& path) { ReadWholeLog(path, AllSignals()); }

void ReadLogWithSensor(const std::string& path) {
  LogReaderOptions options = AllSignals();
  options.topics = {{"/ft", std::nullopt, true}};
  options.want_wrench = options.want_current = true;
  ReadWholeLog(path, options);
}

void ReadAnyRobot(const std::string& path) { ReadRobot(path, {}); }

void ReadAnyPoses(const std::string& path) {
  ReadPoses(path, FuzzedRobot().JointNames());
}

void ReadAnyCalibration(const std::string& path) {
  ReadCalibration(path, FuzzedRobot());
}

// Beside files that the seeds name, of which only the first bytes are read.
void ReadBagFolder(const std::string& path) {
  const std::filesystem::path folder =
      std::filesystem::path(path).parent_path();
  for (const char* name : {"packed.mcap", "split_0.mcap", "split_1.mcap"}) {
    std::ofstream(folder / name, std::ios::binary) << "\x89MCAP0\r\n";
  }
  BagFiles(folder);
}

// Writes the calibration.json and, behind a zero, the matrix beside it that are
// in a file; the path of the first.
std::string WriteCalibration(const std::string& path, const char* matrix) {
  const std::string bytes = BytesOf(path);
  const std::string::size_type zero = bytes.find('\0');
  const std::filesystem::path folder =
      std::filesystem::path(path).parent_path();
  std::ofstream(folder / "calibration.json", std::ios::binary)
      << bytes.substr(0, zero);
  std::ofstream(folder / matrix, std::ios::binary)
      << (zero == std::string::npos ? "" : bytes.substr(zero + 1));
  return folder / "calibration.json";
}

void ReadPosterior(const std::string& path) {
  ReadParameterPosterior(WriteCalibration(path, "parameters_posterior.csv"),
                         FuzzedRobot());
}

void ReadGiven(const std::string& path) {
  const std::string calibration = WriteCalibration(path, "covariance.csv");
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kArmature, JointTerm::kViscous,
                         JointTerm::kCoulomb, JointTerm::kOffset};
  options.transitions.assign(FuzzedRobot().num_joints(), {CoulombTransition()});
  static const ModelParameters model(FuzzedRobot(), options);
  ReadGivenCalibration(calibration, FuzzedRobot(), model);
}

void ReadAnyController(const std::string& path) {
  ReadController(path, FuzzedRobot(), Eigen::Vector2d::Zero());
}

// Behind the checksum, which random bytes never pass.
void ReadFactor(const std::string& path) {
  std::string bytes = BytesOf(path);
  const Sha256::Digest digest = Sha256Of(bytes);
  bytes.append(reinterpret_cast<const char*>(digest.data()), digest.size());
  ParseFactorFile(path, bytes);
}

}  // namespace

const std::vector<FuzzedReader>& FuzzedReaders() {
  static const std::vector<FuzzedReader> readers = {
      {"csv", "input.csv", ReadLog},
      {"gz", "input.csv.gz", ReadLog},
      {"db3", "input.db3", ReadLog},
      {"mcap", "input.mcap", ReadLog},
      {"wrench", "input.mcap", ReadLogWithSensor},
      {"npz", "input.npz", ReadLog},
      {"mat", "input.mat", ReadLog},
      {"urdf", "input.urdf", ReadAnyRobot},
      {"mjcf", "input.mjcf", ReadAnyRobot},
      {"yaml", "input.yaml", ReadAnyRobot},
      {"poses", "input.csv", ReadAnyPoses},
      {"json", "input.json", ReadAnyCalibration},
      {"given", "input", ReadGiven},
      {"posterior", "input", ReadPosterior},
      {"metadata", "metadata.yaml", ReadBagFolder},
      {"controller", "input.yaml", ReadAnyController},
      {"factor", "input.factor", ReadFactor},
  };
  return readers;
}

bool ReadsAs(const FuzzedReader& reader, const std::string& folder,
             const char* bytes, std::size_t size) {
  const std::string path = folder + "/" + reader.file;
  std::ofstream(path, std::ios::binary).write(bytes, size);
  try {
    reader.read(path);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace armcal
