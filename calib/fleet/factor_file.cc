#include "calib/fleet/factor_file.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "calib/fleet/reduction_json.h"
#include "calib/numerics/json_value.h"
#include "calib/numerics/sha256.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using nlohmann::json;

constexpr int kVersion = 1;
constexpr char kFormat[] = "armcal factor ";
constexpr size_t kDigest = 32;

void AddNumber(double number, std::string* bytes) {
  std::uint64_t bits;
  std::memcpy(&bits, &number, sizeof(bits));
  for (int k = 0; k < 8; ++k) *bytes += static_cast<char>(bits >> (8 * k));
}

std::uint64_t Bits(const char* at) {
  std::uint64_t bits = 0;
  for (int k = 0; k < 8; ++k) {
    bits |= std::uint64_t{static_cast<unsigned char>(at[k])} << (8 * k);
  }
  return bits;
}

// Goes through what lies between the first line and the digest.
class FactorReader {
 public:
  FactorReader(const std::string& path, std::string_view body)
      : path_(path), body_(body) {}

  void Expect(std::uint64_t size) const {
    if (size <= body_.size()) return;
    throw InputError(path_, "", "", "ends too early for what it announces");
  }
  std::string_view Take(std::uint64_t size) {
    Expect(size);
    const std::string_view taken = body_.substr(0, size);
    body_.remove_prefix(size);
    return taken;
  }
  std::uint64_t Whole() { return Bits(Take(8).data()); }
  double Number() {
    const std::uint64_t bits = Whole();
    double number;
    std::memcpy(&number, &bits, sizeof(number));
    if (std::isfinite(number)) return number;
    throw InputError(path_, "", NumberText(number),
                     "expected a finite number in the factors");
  }
  Eigen::MatrixXd Triangle(int size) {
    Expect(std::uint64_t{4} * size * (size + 1));
    Eigen::MatrixXd R = Eigen::MatrixXd::Zero(size, size);
    for (int c = 0; c < size; ++c) {
      for (int r = 0; r <= c; ++r) R(r, c) = Number();
    }
    return R;
  }

 private:
  const std::string& path_;
  std::string_view body_;
};

// The version, and what follows its line.
std::string_view ExpectFormat(const std::string& path, std::string_view bytes) {
  const std::string_view format = kFormat;
  const size_t end = bytes.substr(0, 40).find('\n');
  if (bytes.substr(0, format.size()) != format || end == bytes.npos) {
    throw InputError(path, "", OneLine(bytes.substr(0, 20)),
                     "expected a factor file, as armcal reduce writes it");
  }
  const std::string_view version =
      bytes.substr(format.size(), end - format.size());
  if (ParseNumber(version) != kVersion) {
    throw InputError(path, "version", OneLine(version),
                     "expected " + std::to_string(kVersion) +
                         "; a newer armcal wrote this, or none");
  }
  return bytes.substr(end + 1);
}

}  // namespace

std::string FactorFileBytes(const Reduction& reduction) {
  json logs = json::array();
  for (const ReducedLog& log : reduction.logs) logs.push_back(ToJson(log));
  const std::string text =
      json{{"model", ToJson(reduction.model)}, {"logs", logs}}.dump(
          -1, ' ', false, json::error_handler_t::replace);
  std::string bytes = kFormat + std::to_string(kVersion) + "\n";
  for (int k = 0; k < 8; ++k) {
    bytes += static_cast<char>(std::uint64_t{text.size()} >> (8 * k));
  }
  bytes += text;
  for (const ReducedLog& log : reduction.logs) {
    for (const TriangularFactor& factor : log.factors) {
      const Eigen::MatrixXd& R = factor.Triangle();
      for (Eigen::Index c = 0; c < R.cols(); ++c) {
        for (Eigen::Index r = 0; r <= c; ++r) AddNumber(R(r, c), &bytes);
      }
    }
  }
  const Sha256::Digest digest = Sha256Of(bytes);
  return bytes.append(digest.begin(), digest.end());
}

Reduction ParseFactorFile(const std::string& path, std::string_view bytes) {
  const std::string_view rest = ExpectFormat(path, bytes);
  if (rest.size() < 8 + kDigest) {
    throw InputError(path, "", "", "ends too early: it was not written whole");
  }
  const std::string_view checked = bytes.substr(0, bytes.size() - kDigest);
  const Sha256::Digest digest = Sha256Of(checked);
  if (std::memcmp(digest.data(), bytes.data() + checked.size(), kDigest) != 0) {
    throw InputError(path, "checksum", "",
                     "does not fit the content: the file is damaged or not "
                     "whole; reduce the log again");
  }
  FactorReader reader(path, rest.substr(0, rest.size() - kDigest));
  const std::string_view text = reader.Take(reader.Whole());
  const json header = ParseJson(path, text);
  const JsonValue root(path, "", header);
  Reduction reduction{ReadReductionModel(root.At("model")), {}};
  for (const JsonValue& log : root.At("logs").Entries()) {
    reduction.logs.push_back(ReadReducedLog(
        log, [&reader](int columns) { return reader.Triangle(columns); }));
  }
  if (reduction.logs.empty()) {
    root.At("logs").Refuse("expected at least one log");
  }
  return reduction;
}

Reduction ReadFactorFile(const std::string& path) {
  constexpr long kMostBytes = 1L << 30;  // a log takes some kilobytes
  return ParseFactorFile(path, ReadSmallFile(path, kMostBytes, kFormat));
}

}  // namespace armcal
