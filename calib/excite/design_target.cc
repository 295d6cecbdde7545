#include "calib/excite/design_target.h"

#include <Eigen/LU>
#include <functional>

#include "model/dynamics/robot_lengths.h"
#include "problems/inertial_prior.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Quantities {
 public:
  Quantities(const Robot& robot, const ModelParameters& model)
      : robot_(robot), model_(model), at_(model.Values(robot)) {}

  // `with`: the robot with another value. X is a polynomial of at most second
  // degree in it, for which a central difference is exact.
  void Add(const std::string& name, const std::string& unit, double nominal,
           double step, const std::function<Robot(double)>& with) {
    result_.names.push_back(name);
    result_.units.push_back(unit);
    columns_.emplace_back((model_.Values(with(nominal + step)) -
                           model_.Values(with(nominal - step))) /
                          (2 * step));
    nominal_.push_back(nominal);
  }
  void AddInertials() {
    for (int i = 0; i < robot_.num_joints(); ++i) {
      const Vector10d V = robot_.links[i].inertial.ToVector();
      for (int k = 0; k < 10; ++k) {
        Add(robot_.links[i].name + "." + InertialName(k), InertialUnit(k), V[k],
            1, [&, i, k](double value) {
              Robot changed = robot_;
              Vector10d other = V;
              other[k] = value;
              changed.links[i].inertial = InertialParameters::FromVector(other);
              return changed;
            });
      }
    }
  }
  void AddTerms(const std::vector<JointTerm>& terms) {
    for (int j = 0; j < robot_.num_joints(); ++j) {
      const Joint& joint = robot_.links[j].joint;
      for (const JointTerm term : terms) {
        Add(joint.name + "." + JointTermName(term),
            JointTermUnit(term, joint.type), TermOf(term, joint), 1,
            [&](double value) {
              Robot changed = robot_;
              *TermOf(term, &changed.links[j].joint) = value;
              return changed;
            });
      }
    }
  }
  void AddLengths() {
    for (const Length& length : model_.unknown_lengths()) {
      Add(length.owner_name, "m", length.value, .01, [&](double value) {
        Length other = length;
        other.value = value;
        return WithLengths(robot_, {other});
      });
    }
  }
  int size() const { return static_cast<int>(columns_.size()); }
  NamedQuantities Finish() {
    result_.design.J.resize(at_.size(), size());
    for (int k = 0; k < size(); ++k) result_.design.J.col(k) = columns_[k];
    result_.nominal = Eigen::Map<VectorXd>(nominal_.data(), size());
    result_.design.known = MatrixXd::Zero(size(), size());
    return result_;
  }

 private:
  const Robot& robot_;
  const ModelParameters& model_;
  VectorXd at_;
  std::vector<VectorXd> columns_;
  std::vector<double> nominal_;
  NamedQuantities result_;
};

NamedQuantities ModelQuantities(const ModelParameters& model,
                                const VectorXd& nominal,
                                const VectorXd& scale) {
  NamedQuantities all;
  const int m = model.size();
  all.design.J = MatrixXd::Identity(m, m);
  all.design.known = MatrixXd::Zero(m, m);
  all.design.scale = scale;
  all.nominal = nominal;
  for (int k = 0; k < m; ++k) {
    all.names.push_back(model.parameters()[k].name);
    all.units.push_back(model.parameters()[k].unit);
    all.design.wanted.push_back(k);
  }
  return all;
}

}  // namespace

VectorXd TorqueScale(const ReferenceScale& reference) {
  const MatrixXd shares =
      reference.torque.cwiseInverse().asDiagonal() * reference.columns;
  return shares.colwise().norm().transpose().unaryExpr(
      [](double share) { return share > 0 ? 1 / share : 1; });
}

NamedQuantities MakeDesignQuantities(const Robot& robot,
                                     const ModelParameters& model,
                                     const std::vector<JointTerm>& terms,
                                     DesignTarget target, const ArmTrust& trust,
                                     const ReferenceScale& reference,
                                     const MatrixXd& known) {
  if (target == DesignTarget::kModel) {
    NamedQuantities all =
        ModelQuantities(model, model.Values(robot), TorqueScale(reference));
    all.design.known = known;
    return all;
  }
  Quantities quantities(robot, model);
  quantities.AddInertials();
  quantities.AddTerms(terms);
  const int lengths = quantities.size();
  if (target == DesignTarget::kGeometry) quantities.AddLengths();
  NamedQuantities all = quantities.Finish();
  VectorXd prior(quantities.size());
  MatrixXd& information = all.design.known;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const auto W =
        InertialPrior(robot.links[i].inertial.ToVector(), trust.inertia).W();
    information.block<10, 10>(10 * i, 10 * i) = W.transpose() * W;
    prior.segment<10>(10 * i) =
        (W.transpose() * W).inverse().diagonal().cwiseSqrt();
  }
  for (int k = 10 * robot.num_joints(); k < lengths; ++k) {
    const int joint =
        (k - 10 * robot.num_joints()) / static_cast<int>(terms.size());
    prior[k] = trust.joint_terms * reference.torque[joint];
    information(k, k) = 1 / (prior[k] * prior[k]);
  }
  for (int k = lengths; k < prior.size(); ++k) {
    prior[k] = trust.length;
    information(k, k) = 1 / (prior[k] * prior[k]);
  }
  information += all.design.J.transpose() * known * all.design.J;
  const int first = target == DesignTarget::kGeometry ? lengths : 0;
  for (int k = first; k < prior.size(); ++k) all.design.wanted.push_back(k);
  all.design.scale = prior.tail(prior.size() - first);
  return all;
}

}  // namespace armcal
