#include "tools/completion.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "tools/flag_choices.h"
#include "tools/flag_text.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// bash takes only what follows the last "=" or ":" for the word.
constexpr char kBash[] = R"(# armcal in bash: source <(armcal completion bash)
_armcal() {
  local line=${COMP_LINE:0:COMP_POINT} word candidate
  word=${line##*[[:blank:]]}
  local kept=${word%"${word##*[=:]}"}
  COMPREPLY=()
  while IFS=$'\t' read -r candidate _; do
    COMPREPLY+=("${candidate#"$kept"}")
  done < <("${COMP_WORDS[0]}" completion --line "$line" 2>/dev/null)
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[=,/] ]]; then
    compopt -o nospace
  fi
}
complete -F _armcal armcal
)";

constexpr char kZsh[] = R"(#compdef armcal
# armcal in zsh: source <(armcal completion zsh), or a file of $fpath
_armcal() {
  local line
  local -a open closed
  for line in "${(@f)$(${words[1]} completion --line "$LBUFFER" 2>/dev/null)}"
  do
    line=${line%%$'\t'*}
    case $line in
      *[=,/]) open+=("$line") ;;
      ?*) closed+=("$line") ;;
    esac
  done
  compadd -S '' -- $open
  compadd -- $closed
}
if [[ $funcstack[1] == _armcal ]]; then _armcal; else compdef _armcal armcal; fi
)";

constexpr char kFish[] = R"(# armcal in fish: armcal completion fish | source
function __armcal
  set -l words (commandline -po)
  command $words[1] completion --line (commandline -cp | string collect) \
    2>/dev/null
end
complete -c armcal -f -a '(__armcal)'
)";

bool Begins(const std::string& text, const std::string& begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

// Files and folders whose path begins with `begin`, hidden ones if it says so.
Words Files(const std::string& begin, bool folders_only) {
  const size_t slash = begin.rfind('/');
  const std::string folder =
      slash == std::string::npos ? "" : begin.substr(0, slash + 1);
  const std::string name = begin.substr(folder.size());
  Words files;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end;
       !error && entry != end; entry.increment(error)) {
    const std::string found = entry->path().filename().string();
    if (!Begins(found, name) || (name.empty() && found[0] == '.')) continue;
    std::error_code unknown;
    const bool is_folder = entry->is_directory(unknown);
    if (folders_only && !is_folder) continue;
    files.push_back(folder + found + (is_folder ? "/" : ""));
  }
  std::sort(files.begin(), files.end());
  return files;
}

// What may follow "--flag=", all of it; `value` is there already.
Words Values(const FlagText& flag, const std::string& value) {
  FlagWords words = WordsOf(flag.name);
  if (flag.value.empty()) words.words = {"true", "false"};
  const bool list = words.list || flag.value == "FILES";
  const size_t comma = list ? value.rfind(',') : std::string::npos;
  const std::string before =
      comma == std::string::npos ? "" : value.substr(0, comma + 1);
  const std::string last = value.substr(before.size());
  const bool folder = flag.value == "DIR";
  if (words.words.empty() && (folder || Begins(flag.value, "FILE"))) {
    words.words = Files(last, folder);
  }
  Words values;
  for (const std::string& word : words.words) {
    if (Begins(word, last)) values.push_back(before + word);
  }
  return values;
}

std::string OfFlags(const Command& command, const std::string& word,
                    const std::string& line) {
  std::string text;
  for (const std::string& name : command.FlagNames()) {
    const FlagText flag(name);
    const std::string begin = "--" + name + (flag.value.empty() ? "" : "=");
    const bool given = line.find(" --" + name + "=") != std::string::npos;
    if (!given && Begins(begin, word)) {
      text += begin + "\t" + flag.description + "\n";
    }
  }
  return text;
}

std::string Beginning(const Words& words, const std::string& word) {
  std::string text;
  for (const std::string& one : words) {
    if (Begins(one, word)) text += one + "\n";
  }
  return text;
}

std::string Candidates(const std::vector<Command>& commands,
                       const std::string& line) {
  const size_t blank = line.find_last_of(" \t");
  const std::string word =
      blank == std::string::npos ? "" : line.substr(blank + 1);
  std::istringstream before(line.substr(0, line.size() - word.size()));
  std::string program, name, text;
  before >> program >> name;
  if (name.empty() || name == "help") {
    for (const Command& command : commands) {
      if (!Begins(command.name, word)) continue;
      text += command.name + ("\t" + std::string(command.summary)) + "\n";
    }
  }
  if (name.empty()) text += Beginning({"completion", "help"}, word);
  if (name == "completion") text += Beginning({"bash", "zsh", "fish"}, word);
  const auto command =
      std::find_if(commands.begin(), commands.end(),
                   [&](const Command& one) { return name == one.name; });
  if (command == commands.end()) return text;
  const size_t equals = word.find('=');
  if (equals == std::string::npos) {
    return OfFlags(*command, word, line.substr(0, line.size() - word.size()));
  }
  const std::string flag = word.substr(0, equals);
  for (const std::string& known : command->FlagNames()) {
    if (flag != "--" + known) continue;
    for (const std::string& value :
         Values(FlagText(known), word.substr(equals + 1))) {
      text += flag + "=" + value + "\n";
    }
  }
  return text;
}

}  // namespace

std::string Completion(const std::vector<Command>& commands,
                       const Words& words) {
  if (words.size() == 2 && words[0] == "--line")
    return Candidates(commands, words[1]);
  const std::string shell = words.size() == 1 ? words[0] : "";
  if (shell == "bash") return kBash;
  if (shell == "zsh") return kZsh;
  if (shell == "fish") return kFish;
  throw UsageError(
      "expected armcal completion bash, zsh or fish, whose output the shell "
      "is to read");
}

}  // namespace armcal
