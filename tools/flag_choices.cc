#include "tools/flag_choices.h"

#include <algorithm>
#include <map>

#include "model/text/input_text.h"
#include "tools/nearest_name.h"
#include "tools/usage_error.h"

namespace armcal {
namespace {

// Filled before main(), as gflags' own table is.
using AllWords = std::multimap<std::string, std::function<FlagWords()>>;
AllWords& TheWords() {
  static AllWords words;
  return words;
}

}  // namespace

FlagWords WordsOf(const std::string& flag) {
  FlagWords known;
  const auto [begin, end] = TheWords().equal_range(flag);
  for (auto entry = begin; entry != end; ++entry) {
    const FlagWords more = entry->second();
    known.list = known.list || more.list;
    for (const std::string& word : more.words) {
      const auto& words = known.words;
      if (std::count(words.begin(), words.end(), word) > 0) continue;
      known.words.push_back(word);
    }
  }
  // In which order several sources add theirs is the linker's.
  std::sort(known.words.begin(), known.words.end());
  return known;
}

FlagWordsAdded::FlagWordsAdded(const std::string& flag,
                               std::function<FlagWords()> words) {
  TheWords().emplace(flag, std::move(words));
}

void RefuseChoice(const std::string& flag, const std::string& value,
                  const std::vector<std::string>& words) {
  throw UsageError("--" + flag + ": found '" + value + "', expected one of " +
                   JoinNames(words) + DidYouMean(value, words));
}

}  // namespace armcal
