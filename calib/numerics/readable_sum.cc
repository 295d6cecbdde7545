#include "calib/numerics/readable_sum.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/text/input_text.h"

namespace armcal {
namespace {

constexpr double kLeastFactor = 1e-6;  // of the largest factor

struct Term {
  std::string sign;  // " + ", " - ", or nothing in front
  std::string text;
  double factor = 1;
};

// What is in front of the first "*" where that is a number: "a2*hx[3]" is a
// length times a moment.
double FactorOf(const std::string& term) {
  const size_t star = term.find('*');
  if (star == std::string::npos) return 1;
  return std::abs(ParseNumber(term.substr(0, star)).value_or(1));
}

std::vector<Term> TermsOf(const std::string& name) {
  std::vector<Term> terms;
  std::string sign;
  size_t begin = 0;
  while (true) {
    const size_t end =
        std::min(name.find(" + ", begin), name.find(" - ", begin));
    const std::string text = name.substr(begin, end - begin);
    terms.push_back({sign, text, FactorOf(text)});
    if (end == std::string::npos) return terms;
    sign = name.substr(end, 3);
    begin = end + 3;
  }
}

}  // namespace

std::string ReadableSum(const std::string& name) {
  const std::vector<Term> terms = TermsOf(name);
  double largest = 0;
  for (const Term& term : terms) largest = std::max(largest, term.factor);
  std::string text;
  for (const Term& term : terms) {
    if (term.factor < kLeastFactor * largest) continue;
    if (!text.empty()) {
      text += term.sign;
    } else if (term.sign == " - ") {
      text = "-";
    }
    text += term.text;
  }
  return text;
}

std::string InBrackets(const std::string& name) {
  return TermsOf(name).size() > 1 ? "(" + name + ")" : name;
}

}  // namespace armcal
