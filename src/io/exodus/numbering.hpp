// Numbers for named blocks and sets, as Exodus wants both.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace strut::io {

// A reader calls the nameless block 7 "block_7". Where all names are of that kind and distinct, the numbers they carry;
// else 1, 2, …
std::vector<std::int64_t> numbers_of(const std::vector<std::string>& names, const std::string& prefix);

}  // namespace strut::io
