// Numbers for named blocks and sets, because Exodus needs both.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace strut::io {

// A reader calls the unnamed block 7 "block_7". If all names are of this form and distinct, returns their numbers; else
// 1, 2, …
std::vector<std::int64_t> numbers_of(const std::vector<std::string>& names, const std::string& prefix);

}  // namespace strut::io
