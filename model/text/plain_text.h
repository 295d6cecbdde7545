#pragma once

#include <string>
#include <string_view>

namespace armcal {

// Throws InputError, with the file's name, for what is no text that readers
// take: UTF-16, or bytes that are 0.
void RequirePlainText(const std::string& name, std::string_view text);

}  // namespace armcal
