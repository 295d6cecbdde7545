// Real robots simulated over stretches of held-out time, from their measured
// states and with their torque: our refined calibration against what else one
// would simulate them with. Skipped where shared/data is absent.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration.h"
#include "calib/refine/nonlinear_calibration.h"
#include "calib/verify/rollout_figures.h"
#include "model/robot_files/robot_reader.h"
#include "tests/calib/verify/rollout_rivals.h"

namespace armcal::rollout_robots_long_test {

const std::string kData = SHARED_DIR "/data/";

struct Rival {
  std::string name;
  Robot robot;
};

struct Setup {
  std::string folder;
  std::vector<std::string> training;
  TimeRange training_crop;
  std::vector<std::string> held_out;
  TimeRange held_out_crop;
  double bandwidth_hz;
  std::vector<double> torque_constants;
};

class Contest {
 public:
  explicit Contest(const Setup& setup)
      : setup_(setup),
        file_(ReadRobot(kData + setup.folder + "/robot.urdf", {})),
        training_(Open(setup.training, setup.training_crop)),
        held_out_(Open(setup.held_out, setup.held_out_crop)) {
    LinearCalibrationOptions options;
    options.bandwidth_hz = setup.bandwidth_hz;
    const LinearCalibration linear =
        CalibrateLinear(file_, options, training_, nullptr);
    transitions_ = linear.transitions;
    refined_ = CalibrateNonlinear(file_, linear, {}, training_, nullptr).robot;
  }

  const Robot& file() const { return file_; }

  // `links` with friction fitted to the training log, with and without offset
  // and armature.
  void AddFitted(const std::string& name, const Robot& links) {
    using T = JointTerm;
    for (const auto& terms : std::vector<std::vector<T>>{
             {T::kViscous, T::kCoulomb},
             {T::kViscous, T::kCoulomb, T::kOffset},
             {T::kViscous, T::kCoulomb, T::kArmature},
             {T::kViscous, T::kCoulomb, T::kOffset, T::kArmature}}) {
      std::string text = name + " with fitted";
      for (const T term : terms) text += std::string(" ") + JointTermName(term);
      rivals_.push_back(
          {text, WithFittedTerms(links, transitions_, terms,
                                 setup_.bandwidth_hz, training_)});
    }
  }
  void Add(const Rival& rival) { rivals_.push_back(rival); }

  // Ours are nearer than each rival's, beyond what chance explains.
  void Run() {
    std::vector<RolloutModel> models = {{refined_, transitions_}};
    for (const Rival& rival : rivals_) {
      models.push_back({rival.robot, transitions_});
    }
    RolloutOptions options;
    options.windows_s = {0.5};
    const Rollouts rollouts =
        RollOut(models, options, setup_.bandwidth_hz, held_out_)[0];
    const auto joints = JointsWithUnit(file_, "rad");
    const RolloutFigure ours = MedianError(rollouts, 0, joints, 1);
    std::printf("%zu windows of 0.5 s: ours %.4f [%.4f %.4f] rad\n",
                rollouts.windows.size(), ours.value, ours.low, ours.high);
    EXPECT_EQ(rollouts.NumDiverged(0), 0);
    for (size_t k = 0; k < rivals_.size(); ++k) {
      const int model = static_cast<int>(k) + 1;
      const RolloutFigure theirs = MedianError(rollouts, model, joints, 1);
      const RolloutFigure ratio = MedianRatio(rollouts, 0, model, joints, 1);
      std::printf("  %-62s %.4f [%.4f %.4f], ours / this %.2f [%.2f %.2f]%s\n",
                  rivals_[k].name.c_str(), theirs.value, theirs.low,
                  theirs.high, ratio.value, ratio.low, ratio.high,
                  ratio.can_judge() ? "" : ", too few to judge");
      EXPECT_LT(ratio.high, 1) << rivals_[k].name;
    }
  }

 private:
  LogSet Open(const std::vector<std::string>& names, const TimeRange& crop) {
    std::vector<std::string> paths;
    for (const auto& name : names) {
      paths.push_back(kData + setup_.folder + "/" + name);
    }
    LogReaderOptions options;
    options.joint_names = file_.JointNames();
    options.torque_constants = setup_.torque_constants;
    return LogSet(LogFiles(paths), options, crop);
  }

  Setup setup_;
  Robot file_;
  LogSet training_, held_out_;
  std::vector<CoulombTransition> transitions_;
  Robot refined_;
  std::vector<Rival> rivals_;
};

#define SKIP_WITHOUT(folder)                                      \
  if (!std::filesystem::exists(kData + (folder))) {               \
    GTEST_SKIP() << "shared/data/" << (folder) << " is not here"; \
  }

TEST(Ur10e, RolloutsAreNearerTheLog) {
  SKIP_WITHOUT("ur10e_free");
  Contest contest({"ur10e_free",
                   {"id_50s.csv"},
                   {},
                   {"val_ptp.csv", "id_30s.csv"},
                   {},
                   6,
                   {14.87, 13.26, 11.13, 10.62, 11.03, 11.47}});
  contest.AddFitted("file", contest.file());
  contest.Run();
}

TEST(Panda, RolloutsAreNearerTheLog) {
  SKIP_WITHOUT("panda");
  Contest contest(
      {"panda", {"log.csv"}, {0, 14}, {"log.csv"}, {14, 21}, 8, {}});
  const Robot published = WithPublishedGravity(contest.file());
  contest.AddFitted("file", contest.file());
  contest.AddFitted("published gravity", published);
  contest.Add(
      {"published gravity and friction", WithPublishedFriction(published)});
  contest.Run();
}

}  // namespace armcal::rollout_robots_long_test
