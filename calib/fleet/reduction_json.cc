#include "calib/fleet/reduction_json.h"

#include <limits>

namespace armcal {
namespace {

using nlohmann::json;

template <class T>
struct Name {
  const char* text;
  T value;
};
constexpr Name<GeometryKnowledge> kGeometries[] = {
    {"known", GeometryKnowledge::kKnown},
    {"declared_lengths", GeometryKnowledge::kDeclaredLengths},
    {"lengths", GeometryKnowledge::kNonzeroLengths},
    {"all_lengths", GeometryKnowledge::kAllLengths}};
constexpr Name<Identification> kIdentifications[] = {
    {"weak", Identification::kWeak},
    {"differential", Identification::kDifferential},
    {"integral", Identification::kIntegral}};
constexpr Name<Quadrature> kQuadratures[] = {
    {"trapezoid", Quadrature::kTrapezoid}, {"simpson", Quadrature::kSimpson}};
constexpr Name<RobustLoss> kLosses[] = {{"squared", RobustLoss::kSquared},
                                        {"huber", RobustLoss::kHuber},
                                        {"cauchy", RobustLoss::kCauchy},
                                        {"tukey", RobustLoss::kTukey}};
constexpr Name<CoulombTransition::Law> kLaws[] = {
    {"velocity", CoulombTransition::Law::kVelocity},
    {"displacement", CoulombTransition::Law::kDisplacement}};
constexpr JointTerm kNamedTerms[] = {JointTerm::kViscous, JointTerm::kCoulomb,
                                     JointTerm::kOffset, JointTerm::kArmature};

template <class T, size_t N>
const char* NameOf(const Name<T> (&names)[N], T value) {
  for (const Name<T>& name : names) {
    if (name.value == value) return name.text;
  }
  return "";
}

template <class T, size_t N>
T Read(const Name<T> (&names)[N], const JsonValue& value) {
  for (const Name<T>& name : names) {
    if (value.Text() == name.text) return name.value;
  }
  value.Refuse("expected a word that this armcal knows");
}

JointTerm ReadTerm(const JsonValue& value) {
  for (const JointTerm term : kNamedTerms) {
    if (value.Text() == JointTermName(term)) return term;
  }
  value.Refuse("expected a word that this armcal knows");
}

template <class Vector>
std::vector<double> List(const Vector& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

std::vector<double> ReadNumbers(const JsonValue& list) {
  std::vector<double> numbers;
  for (const JsonValue& entry : list.Entries()) {
    numbers.push_back(entry.Number());
  }
  return numbers;
}

std::vector<long> ReadCounts(const JsonValue& list) {
  std::vector<long> counts;
  for (const JsonValue& entry : list.Entries()) {
    counts.push_back(entry.Count());
  }
  return counts;
}

int ReadInt(const JsonValue& value) {
  constexpr long kMost = std::numeric_limits<int>::max();
  const long count = value.Count();
  if (count > kMost) value.Refuse("expected at most " + std::to_string(kMost));
  return static_cast<int>(count);
}

double ReadPositive(const JsonValue& value) {
  const double number = value.Number();
  if (!(number > 0)) value.Refuse("expected a number above 0");
  return number;
}

Eigen::VectorXd ReadVector(const JsonValue& list, size_t size) {
  const std::vector<double> numbers = ReadNumbers(list);
  if (numbers.size() != size) {
    list.Refuse("expected " + std::to_string(size) + " numbers");
  }
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), numbers.size());
}

std::vector<std::string> ReadTexts(const JsonValue& list) {
  std::vector<std::string> texts;
  for (const JsonValue& entry : list.Entries()) texts.push_back(entry.Text());
  return texts;
}

std::optional<double> ReadOptional(const JsonValue& of, const char* key) {
  if (!of.Has(key)) return std::nullopt;
  return of.At(key).Number();
}

}  // namespace

json ToJson(const ReductionModel& model) {
  json terms = json::array(), transitions = json::array();
  for (const JointTerm term : model.joint_terms) {
    terms.push_back(JointTermName(term));
  }
  for (const CoulombTransition& t : model.transitions) {
    transitions.push_back({{"law", NameOf(kLaws, t.law)}, {"width", t.width}});
  }
  const RowOptions& rows = model.rows;
  return {{"robot", model.robot},
          {"robot_sha256", model.robot_sha256},
          {"gravity", List(model.gravity)},
          {"geometry", NameOf(kGeometries, model.geometry)},
          {"joint_terms", terms},
          {"coulomb_transitions", transitions},
          {"identification", NameOf(kIdentifications, rows.identification)},
          {"window_s", rows.window_s},
          {"hops", rows.hops},
          {"interval_s", rows.interval_s},
          {"quadrature", NameOf(kQuadratures, rows.quadrature)},
          {"bandwidth_hz", rows.bandwidth_hz},
          {"loss", NameOf(kLosses, model.loss)},
          {"parameters", model.parameters},
          {"units", model.units}};
}

json ToJson(const ReducedLog& log) {
  json rows = json::array(), columns = json::array();
  for (const TriangularFactor& factor : log.factors) {
    rows.push_back(factor.rows());
    columns.push_back(factor.columns());
  }
  json entry = {{"file", log.file},
                {"sha256", log.sha256},
                {"torque", log.torque},
                {"torque_constants_stddev", log.torque_constants_stddev},
                {"unit", log.unit},
                {"samples", log.samples},
                {"begin_s", log.range.begin},
                {"end_s", log.range.end},
                {"resampled", log.resampled},
                {"gaps", log.gaps},
                {"motion_hz", log.motion_hz},
                {"mean_square_speed", List(log.mean_square_speed)},
                {"travel", List(log.travel)},
                {"rows", rows},
                {"columns", columns}};
  if (log.time) entry["time"] = *log.time;
  if (log.inflation) entry["inflation"] = *log.inflation;
  return entry;
}

ReductionModel ReadReductionModel(const JsonValue& entry) {
  ReductionModel model;
  model.robot = entry.At("robot").Text();
  model.robot_sha256 = entry.At("robot_sha256").Text();
  model.gravity = ReadVector(entry.At("gravity"), 3);
  model.parameters = ReadTexts(entry.At("parameters"));
  model.units = ReadTexts(entry.At("units"));
  model.geometry = Read(kGeometries, entry.At("geometry"));
  for (const JsonValue& term : entry.At("joint_terms").Entries()) {
    model.joint_terms.push_back(ReadTerm(term));
  }
  for (const JsonValue& t : entry.At("coulomb_transitions").Entries()) {
    model.transitions.push_back(
        {Read(kLaws, t.At("law")), t.At("width").Number()});
  }
  RowOptions& rows = model.rows;
  rows.identification = Read(kIdentifications, entry.At("identification"));
  rows.window_s = ReadPositive(entry.At("window_s"));
  rows.hops = ReadInt(entry.At("hops"));
  if (rows.hops < 1) entry.At("hops").Refuse("expected at least 1");
  rows.interval_s = ReadPositive(entry.At("interval_s"));
  rows.quadrature = Read(kQuadratures, entry.At("quadrature"));
  rows.bandwidth_hz = entry.At("bandwidth_hz").Number();
  model.loss = Read(kLosses, entry.At("loss"));
  return model;
}

ReducedLog ReadReducedLog(const JsonValue& entry, const ReadTriangle& read) {
  ReducedLog log;
  log.file = entry.At("file").Text();
  log.sha256 = entry.At("sha256").Text();
  log.torque = entry.At("torque").Text();
  log.torque_constants_stddev =
      ReadOptional(entry, "torque_constants_stddev").value_or(0);
  log.unit = entry.At("unit").Text();
  log.time = ReadOptional(entry, "time");
  log.samples = entry.At("samples").Count();
  log.range = {entry.At("begin_s").Number(), entry.At("end_s").Number()};
  log.resampled = entry.At("resampled").Bool();
  log.gaps = ReadInt(entry.At("gaps"));
  log.motion_hz = entry.At("motion_hz").Number();
  log.inflation = ReadOptional(entry, "inflation");
  const std::vector<long> rows = ReadCounts(entry.At("rows"));
  const std::vector<long> columns = ReadCounts(entry.At("columns"));
  log.mean_square_speed =
      ReadVector(entry.At("mean_square_speed"), rows.size()).array();
  log.travel = ReadVector(entry.At("travel"), rows.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    if (columns.size() != rows.size() || columns[i] > 10000) {
      entry.At("columns").Refuse(
          "expected as many numbers as rows has, of at most 10000");
    }
    log.factors.emplace_back(read(static_cast<int>(columns[i]) + 1), rows[i]);
  }
  return log;
}

}  // namespace armcal
