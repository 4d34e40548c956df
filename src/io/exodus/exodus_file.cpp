#include "io/exodus/exodus_file.hpp"

#include <exodusII.h>
#include <netcdf.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

#include "base/errors.hpp"
#include "io/exodus/exodus_words.hpp"
#include "io/netcdf/classic_netcdf.hpp"

namespace strut::io {

namespace {

namespace fs = std::filesystem;

// The cause of an error code: of the system (positive), of netCDF (negative) or of Exodus itself.
std::string cause_of(int code) {
  const char* message = nullptr;
  const char* function = nullptr;
  int last = 0;
  ex_get_err(&message, &function, &last);
  if (last == 0) last = code;
  if (last > 0 && last < 1000) return std::strerror(last);
  static const std::map<int, std::string> netcdf = {{-31, "the system failed while reading or writing"},
                                                    {-36, "an invalid argument"},
                                                    {-40, "an index out of bounds"},
                                                    {-46, "a dimension that is not there"},
                                                    {-49, "a variable that is not there"},
                                                    {-51, "not an Exodus (netCDF) file"},
                                                    {-60, "a number out of range of the file's type"},
                                                    {-61, "out of memory (a damaged file?)"},
                                                    {-62, "a variable too large for the file format"},
                                                    {-101, "the HDF5 layer failed: a damaged file or a full disk"}};
  if (const auto known = netcdf.find(last); known != netcdf.end()) return known->second;
  const std::string text = message == nullptr ? "" : message;
  return (text.empty() ? "Exodus library" : text) + " (code " + std::to_string(last) + ")";
}

// Checks errors for which the library has only codes, so that the message is plain.
void check_that_it_may_be_read(const fs::path& path, std::int64_t frames) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail_at(path, "open it", "no such file");
  if (fs::is_directory(status)) fail_at(path, "open it", "it is a directory");
  if (!fs::is_regular_file(status)) fail_at(path, "open it", "not a regular file");
  if (fs::file_size(path, error) == 0) fail_at(path, "open it", "the file is empty");
  const std::string problem = classic_netcdf_problem(path, frames);
  if (!problem.empty()) fail_at(path, "open it", problem);
}

// Compressed data in an HDF5 file may be this much larger in memory: deflate's limit.
constexpr std::int64_t densest = 1032;

std::int64_t largest_content(const fs::path& path) {
  std::error_code ignored;
  const auto size = static_cast<std::int64_t>(fs::file_size(path, ignored));
  return is_hdf5(path) ? densest * size : size;
}

}  // namespace

ExodusFile ExodusFile::open(const fs::path& path, Access access, std::int64_t frames) {
  ex_opts(0);  // we report errors ourselves
  check_that_it_may_be_read(path, frames);
  int word_size = sizeof(double);
  int file_word_size = 0;
  float version = 0;
  const int mode = access == Access::write ? EX_WRITE : EX_READ;
  const int handle = ex_open(path.c_str(), mode, &word_size, &file_word_size, &version);
  if (handle < 0) fail_at(path, "open it", cause_of(handle));
  ExodusFile file(path, handle);
  file.largest_ = largest_content(path);
  ex_set_int64_status(handle, EX_ALL_INT64_API);
  ex_set_max_name_length(handle, longest_name);
  return file;
}

namespace {

// Largest size of a variable in one frame, in the classic format with 64-bit offsets (CDF-2), bytes.
constexpr std::int64_t largest_of_offsets = 4'294'967'288;

int created(const fs::path& path, int mode) {
  int word_size = sizeof(double);
  int file_word_size = sizeof(double);
  errno = 0;
  return ex_create(path.c_str(), mode | EX_CLOBBER | EX_ALL_INT64_API, &word_size, &file_word_size);
}

// Creates the classic format with 64-bit sizes (CDF-5), which Exodus before version 7 does not name, but leaves to
// netCDF.
int created_with_64_bit_sizes(const fs::path& path) {
#ifdef EX_64BIT_DATA
  return created(path, EX_64BIT_DATA);
#else
  int usual = 0;
  nc_set_default_format(NC_FORMAT_64BIT_DATA, &usual);
  const int handle = created(path, EX_NORMAL_MODEL | EX_NOCLASSIC);  // neither names a format
  nc_set_default_format(usual, nullptr);
  const int large = 1;  // components of vectors are variables of their own, as by EX_LARGE_MODEL
  const int code = handle < 0 ? handle : nc_put_att_int(handle, NC_GLOBAL, "file_size", NC_INT, 1, &large);
  return code < 0 ? code : handle;
#endif
}

}  // namespace

// A classic format instead of HDF5: it is complete on disk after each flush, so a killed run loses only the present
// frame. Its integers have 32 bits, enough for 2·10⁹ points.
ExodusFile ExodusFile::create(const fs::path& path, std::int64_t largest_variable) {
  ex_opts(0);
  const bool fits = largest_variable <= largest_of_offsets;
  const int handle = fits ? created(path, EX_LARGE_MODEL) : created_with_64_bit_sizes(path);
  if (handle < 0) fail_at(path, "create it", cause_of(handle));
  ExodusFile file(path, handle);
  file.check(ex_set_max_name_length(handle, longest_name), "set the length of names");
  return file;
}

ExodusFile::~ExodusFile() {
  if (handle_ >= 0) ex_close(handle_);
}

ExodusFile::ExodusFile(ExodusFile&& other) noexcept
    : path_(std::move(other.path_)), handle_(std::exchange(other.handle_, -1)), largest_(other.largest_) {}

void ExodusFile::check(int code, std::string_view doing) const {
  if (code < 0) fail_at(path_, doing, cause_of(code));
}

std::int64_t ExodusFile::inquire(int what, std::string_view doing) const {
  const std::int64_t value = ex_inquire_int(handle_, static_cast<ex_inquiry>(what));
  if (value < 0) fail_at(path_, doing, cause_of(static_cast<int>(value)));
  return value;
}

// ---- reading

int ExodusFile::entity(On on) { return on == On::nodes ? EX_NODAL : EX_ELEM_BLOCK; }

// Checks a count from the file before memory is allocated: `count` of `what`, each with at least `bytes` in the file.
std::int64_t ExodusFile::plausible(std::int64_t count, std::int64_t bytes, const std::string& what) const {
  if (count >= 0 && count <= largest_ / bytes) return count;
  fail_at(path_, "read it",
          "it claims " + std::to_string(count) + " " + what + ", for which it is too small (damaged?)");
}

ExodusFile::Sizes ExodusFile::sizes() const {
  ex_init_params params = {};
  check(ex_get_init_ext(handle_, &params), "read its sizes");
  constexpr int number = 4;  // bytes of the smallest type in Exodus
  return {params.num_dim, plausible(params.num_nodes, number, "nodes"), plausible(params.num_elem, 1, "elements"),
          plausible(params.num_elem_blk, number, "blocks"), plausible(params.num_node_sets, number, "node sets")};
}

std::vector<ExodusFile::Block> ExodusFile::blocks() const {
  const std::int64_t count = sizes().blocks;
  if (count == 0) return {};
  std::vector<std::int64_t> ids(count);
  check(ex_get_ids(handle_, EX_ELEM_BLOCK, ids.data()), "read the ids of its blocks");
  NameTable names(count, longest_name);
  check(ex_get_names(handle_, EX_ELEM_BLOCK, names.data()), "read the names of its blocks");
  std::vector<Block> blocks;
  for (std::int64_t i = 0; i < count; ++i) {
    ex_block raw = {};
    raw.id = ids[i];
    raw.type = EX_ELEM_BLOCK;
    check(ex_get_block_param(handle_, &raw), "read block " + std::to_string(ids[i]));
    const std::string mask = " of block " + std::to_string(ids[i]);
    plausible(raw.num_entry, 1, "elements" + mask);
    plausible(raw.num_nodes_per_entry, 1, "nodes an element" + mask);
    NameTable attributes(plausible(raw.num_attribute, 1, "attributes" + mask), longest_name);
    if (raw.num_attribute > 0) {
      check(ex_get_attr_names(handle_, EX_ELEM_BLOCK, raw.id, attributes.data()), "read the names of attributes");
    }
    blocks.push_back({raw.id, names[i], raw.topology, raw.num_entry, raw.num_nodes_per_entry, attributes.names()});
  }
  return blocks;
}

std::vector<ExodusFile::NodeSet> ExodusFile::node_sets() const {
  const std::int64_t count = sizes().node_sets;
  if (count == 0) return {};
  std::vector<std::int64_t> ids(count);
  check(ex_get_ids(handle_, EX_NODE_SET, ids.data()), "read the ids of its node sets");
  NameTable names(count, longest_name);
  check(ex_get_names(handle_, EX_NODE_SET, names.data()), "read the names of its node sets");
  std::vector<NodeSet> sets;
  for (std::int64_t i = 0; i < count; ++i) {
    std::int64_t nodes = 0;
    std::int64_t factors = 0;
    check(ex_get_set_param(handle_, EX_NODE_SET, ids[i], &nodes, &factors), "read node set " + std::to_string(ids[i]));
    sets.push_back({ids[i], names[i], plausible(nodes, 4, "nodes of node set " + std::to_string(ids[i]))});
  }
  return sets;
}

std::array<std::vector<double>, 3> ExodusFile::coordinates(std::int64_t begin, std::int64_t count) const {
  std::array<std::vector<double>, 3> x;
  for (auto& column : x) column.resize(count);
  if (count == 0) return x;
  check(ex_get_partial_coord(handle_, begin + 1, count, x[0].data(), x[1].data(), x[2].data()), "read the coordinates");
  // The library skips a column that is the file's first variable, as other writers have it.
  const std::array<const char*, 3> names = {"coordx", "coordy", "coordz"};
  const auto first = static_cast<std::size_t>(begin), many = static_cast<std::size_t>(count);
  for (int axis = 0; axis < 3; ++axis) {
    int number = -1;
    if (nc_inq_varid(handle_, names[axis], &number) != NC_NOERR || number != 0) continue;
    check(nc_get_vara_double(handle_, number, &first, &many, x[axis].data()), "read the coordinates");
  }
  return x;
}

std::vector<std::int64_t> ExodusFile::connectivity(const Block& block, std::int64_t begin, std::int64_t count) const {
  // Neither factor is negative or exceeds the size of the file.
  const double entries = static_cast<double>(block.elements) * static_cast<double>(block.nodes_per_element);
  plausible(static_cast<std::int64_t>(std::min(entries, 1e18)), 4,
            "nodes of elements in block " + quoted(block.name, block.id));
  std::vector<std::int64_t> nodes(count * block.nodes_per_element);
  if (nodes.empty()) return nodes;
  check(ex_get_partial_conn(handle_, EX_ELEM_BLOCK, block.id, begin + 1, count, nodes.data(), nullptr, nullptr),
        "read the elements of block " + quoted(block.name, block.id));
  return nodes;
}

std::vector<double> ExodusFile::attribute(const Block& block, int index, std::int64_t begin, std::int64_t count) const {
  std::vector<double> values(count);
  if (values.empty()) return values;
  check(ex_get_partial_one_attr(handle_, EX_ELEM_BLOCK, block.id, begin + 1, count, index + 1, values.data()),
        "read the attributes of block " + quoted(block.name, block.id));
  return values;
}

std::vector<std::int64_t> ExodusFile::nodes_of(const NodeSet& set, std::int64_t begin, std::int64_t count) const {
  std::vector<std::int64_t> nodes(count);
  if (nodes.empty()) return nodes;
  check(ex_get_partial_node_set(handle_, set.id, begin + 1, count, nodes.data()),
        "read the nodes of node set " + quoted(set.name, set.id));
  return nodes;
}

std::vector<std::int64_t> ExodusFile::numbers(On on, std::int64_t begin, std::int64_t count) const {
  std::vector<std::int64_t> numbers(count);
  if (numbers.empty()) return numbers;
  const bool nodes = on == On::nodes;
  check(ex_get_partial_id_map(handle_, nodes ? EX_NODE_MAP : EX_ELEM_MAP, begin + 1, count, numbers.data()),
        std::string("read the numbers of its ") + (nodes ? "nodes" : "elements"));
  return numbers;
}

std::vector<double> ExodusFile::times() const {
  std::vector<double> times(plausible(inquire(EX_INQ_TIME, "read its number of time steps"), 4, "time steps"));
  if (!times.empty()) check(ex_get_all_times(handle_, times.data()), "read its times");
  return times;
}

std::vector<std::string> ExodusFile::variable_names(On on) const {
  int count = 0;
  check(ex_get_variable_param(handle_, static_cast<ex_entity_type>(entity(on)), &count),
        "read its number of variables");
  if (count == 0) return {};
  NameTable names(plausible(count, 1, "variables"), longest_name);
  check(ex_get_variable_names(handle_, static_cast<ex_entity_type>(entity(on)), count, names.data()),
        "read the names of its variables");
  return names.names();
}

std::vector<double> ExodusFile::nodal_values(int step, int variable) const {
  return nodal_values(step, variable, 0, sizes().nodes);
}

std::vector<double> ExodusFile::nodal_values(int step, int variable, std::int64_t begin, std::int64_t count) const {
  std::vector<double> values(count);
  check(ex_get_partial_var(handle_, step + 1, EX_NODAL, variable + 1, 1, begin + 1, count, values.data()),
        "read nodal variable " + std::to_string(variable + 1) + " of step " + std::to_string(step + 1));
  return values;
}

std::vector<double> ExodusFile::element_values(int step, int variable, const Block& block, std::int64_t begin,
                                               std::int64_t count) const {
  const int variables = static_cast<int>(variable_names(On::elements).size());
  std::vector<int> defined(plausible(variables, 4, "variables of a block"));
  check(ex_get_object_truth_vector(handle_, EX_ELEM_BLOCK, block.id, variables, defined.data()),
        "read which variables block " + quoted(block.name, block.id) + " has");
  std::vector<double> values(count, std::numeric_limits<double>::quiet_NaN());
  if (count == 0 || defined[variable] == 0) return values;
  check(ex_get_partial_var(handle_, step + 1, EX_ELEM_BLOCK, variable + 1, block.id, begin + 1, count, values.data()),
        "read element variable " + std::to_string(variable + 1) + " of step " + std::to_string(step + 1));
  return values;
}

std::vector<double> ExodusFile::element_values(int step, int variable) const {
  std::vector<double> values;
  for (const Block& block : blocks()) {
    const std::vector<double> of_block = element_values(step, variable, block, 0, block.elements);
    values.insert(values.end(), of_block.begin(), of_block.end());
  }
  return values;
}

}  // namespace strut::io
