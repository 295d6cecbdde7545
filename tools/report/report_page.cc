#include "tools/report/report_page.h"

#include <ceres/version.h>
#include <openssl/evp.h>

#include <Eigen/Core>
#include <array>
#include <limits>
#include <string_view>

#include "calib/numerics/sha256.h"
#include "model/text/input_error.h"
#include "tools/report/assets.h"

namespace armcal {
namespace {

// The source expression of a content security policy.
std::string PolicySource(std::string_view script) {
  const Sha256::Digest digest = Sha256Of(script);
  std::array<unsigned char, 48> text{};
  EVP_EncodeBlock(text.data(), digest.data(), digest.size());
  return std::string("'sha256-") + reinterpret_cast<char*>(text.data()) + "'";
}

// JSON that may stand in a script element: nothing in it ends the element.
std::string ScriptSafe(const nlohmann::json& data) {
  using nlohmann::json;
  const std::string text =
      data.dump(-1, ' ', false, json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) safe += c == '<' ? "\\u003c" : std::string(1, c);
  return safe;
}

nlohmann::json Versions(const std::string& source_hash) {
  return {{"armcal", ARMCAL_VERSION},
          {"sources", source_hash},
          {"ceres", CERES_VERSION_STRING},
          {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." +
                        std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION)}};
}

nlohmann::json PageData(const ReportContent& content) {
  return {{"command", content.command},
          {"robot", content.robot},
          {"result", content.result},
          {"torques", content.torques},
          {"skeleton", content.skeleton},
          {"extra", content.extra},
          {"provenance", ProvenanceJson(content)}};
}

std::string Element(const std::string& tag, const std::string& attributes,
                    std::string_view content) {
  return "<" + tag + attributes + ">" + std::string(content) + "</" + tag +
         ">\n";
}

}  // namespace

SourceFile HashFile(const std::string& path) {
  const FileHash hash = HashOfFile(path);
  return {path, hash.sha256, hash.bytes};
}

SourceFile HashDocument(const Document& document) {
  if (document.is_file()) return HashFile(document.name());
  const std::string text = document.Text(std::numeric_limits<long>::max());
  return {document.name(), HexText(Sha256Of(text)),
          static_cast<long>(text.size())};
}

nlohmann::json ProvenanceJson(const ReportContent& content) {
  nlohmann::json files = nlohmann::json::array();
  for (const SourceFile& file : content.files) {
    files.push_back(
        {{"path", file.path}, {"sha256", file.sha256}, {"bytes", file.bytes}});
  }
  return {{"arguments", content.arguments},
          {"versions", Versions(content.source_hash)},
          {"files", files}};
}

std::string ReportPage(const ReportContent& content) {
  const std::string_view scripts[] = {DygraphsScript(), ReportScript()};
  std::string sources, elements;
  for (const std::string_view script : scripts) {
    sources += " " + PolicySource(script);
    elements += Element("script", "", script);
  }
  const std::string policy =
      "default-src 'none'; script-src" + sources +
      "; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
      "form-action 'none'";
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n"
         "<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         policy +
         "\">\n"
         "<meta name=\"viewport\" content=\"width=device-width\">\n"
         "<title>armcal</title>\n" +
         Element("style", "", DygraphsStyle()) +
         Element("style", "", ReportStyle()) +
         "</head>\n<body>\n<main id=\"page\"></main>\n"
         "<noscript>This report draws itself with a script.</noscript>\n" +
         Element("script", " type=\"application/json\" id=\"data\"",
                 ScriptSafe(PageData(content))) +
         elements + "</body>\n</html>\n";
}

}  // namespace armcal
