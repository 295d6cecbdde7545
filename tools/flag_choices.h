#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace armcal {

// What a flag's value can be, for refusals and for the shells' completion:
// words, and whether several of them may stand with commas between them. Empty
// where the flag takes something else.
struct FlagWords {
  std::vector<std::string> words;
  bool list = false;
};
FlagWords WordsOf(const std::string& flag);

// Adds to WordsOf(flag), which asks for the words only when it is called.
class FlagWordsAdded {
 public:
  FlagWordsAdded(const std::string& flag, std::function<FlagWords()> words);
};

// UsageError that lists the words.
[[noreturn]] void RefuseChoice(const std::string& flag,
                               const std::string& value,
                               const std::vector<std::string>& words);

// The words that a flag takes, with what they mean; stands beside the flag's
// definition, as a constant.
template <class T>
class FlagChoices {
 public:
  FlagChoices(const std::string& flag,
              std::vector<std::pair<std::string, T>> choices, bool list = false)
      : flag_(flag), choices_(std::move(choices)) {
    const FlagWords words = {Words(), list};
    FlagWordsAdded(flag, [words] { return words; });
  }

  // Throws UsageError for a word that is none of them.
  T Parse(const std::string& value) const {
    for (const auto& [word, choice] : choices_) {
      if (word == value) return choice;
    }
    RefuseChoice(flag_, value, Words());
  }

 private:
  std::vector<std::string> Words() const {
    std::vector<std::string> words;
    for (const auto& choice : choices_) words.push_back(choice.first);
    return words;
  }

  std::string flag_;
  std::vector<std::pair<std::string, T>> choices_;
};

}  // namespace armcal
