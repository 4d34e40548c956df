#include "topology/partition.hpp"

#include <zoltan_cpp.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"

namespace strut {

namespace {

// A point, in the form in which it is sent; the numbers of its shape and its shared nodes follow separately.
struct Parcel {
  std::int64_t id, element_id;
  double position[3];
  double volume, spacing;
  int block;
  std::uint64_t sets;
  bool has_shape, has_shared_nodes;
  int shared_nodes;
};

Parcel packed(const PointCloud& cloud, std::size_t i) {
  const Vector& X = cloud.positions[i];
  const bool has_shared_nodes = !cloud.shared_nodes.empty();
  return {cloud.ids[i],       cloud.element_ids[i],
          {X[0], X[1], X[2]}, cloud.volumes[i],
          cloud.spacings[i],  cloud.blocks[i],
          cloud.sets[i],      !cloud.shapes.empty(),
          has_shared_nodes,   has_shared_nodes ? static_cast<int>(cloud.shared_nodes[i].size()) : 0};
}

void append(PointCloud& cloud, const Parcel& parcel) {
  cloud.ids.push_back(parcel.id);
  cloud.element_ids.push_back(parcel.element_id);
  cloud.positions.emplace_back(parcel.position[0], parcel.position[1], parcel.position[2]);
  cloud.volumes.push_back(parcel.volume);
  cloud.spacings.push_back(parcel.spacing);
  cloud.blocks.push_back(parcel.block);
  cloud.sets.push_back(parcel.sets);
}

// Appends point i of `from`.
void append(PointCloud& cloud, const PointCloud& from, std::size_t i) {
  append(cloud, packed(from, i));
  if (!from.shapes.empty()) cloud.shapes.push_back(from.shapes[i]);
  if (!from.shared_nodes.empty()) cloud.shared_nodes.push_back(from.shared_nodes[i]);
}

// Data for Zoltan's callbacks.
struct PointsToDivide {
  const PointCloud& cloud;
  const std::vector<double>& costs;
  Vector lengths;
};

const PointCloud& cloud_of(void* data) { return static_cast<const PointsToDivide*>(data)->cloud; }

int count(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(cloud_of(data).size());
}

void list(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int weights, float* weight, int* error) {
  const PointCloud& cloud = cloud_of(data);
  const std::vector<double>& costs = static_cast<const PointsToDivide*>(data)->costs;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    global[i] = static_cast<ZOLTAN_ID_TYPE>(cloud.ids[i]);
    local[i] = static_cast<ZOLTAN_ID_TYPE>(i);
    if (weights == 1) weight[i] = static_cast<float>(costs[i]);
  }
  *error = ZOLTAN_OK;
}

int dimensions(void*, int* error) {
  *error = ZOLTAN_OK;
  return 3;
}

void place(void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, double* position, int* error) {
  Eigen::Map<Vector>{position} =
      cloud_of(data).positions[*local].cwiseProduct(static_cast<const PointsToDivide*>(data)->lengths);
  *error = ZOLTAN_OK;
}

void require(int status, const char* what) {
  if (status != ZOLTAN_OK && status != ZOLTAN_WARN) throw Error(std::string("Zoltan failed to ") + what);
}

Zoltan started_zoltan(const Communicator& communicator, PointsToDivide& to_divide) {
  float version = 0;
  require(Zoltan_Initialize(0, nullptr, &version), "start");
  const auto mpi = Teuchos::rcp_dynamic_cast<const Teuchos::MpiComm<int>>(communicator.teuchos());
  Zoltan zoltan(*mpi->getRawMpiComm());
  zoltan.Set_Param("DEBUG_LEVEL", "0");
  zoltan.Set_Param("LB_METHOD", "RCB");
  zoltan.Set_Param("RETURN_LISTS", "EXPORT");
  zoltan.Set_Param("OBJ_WEIGHT_DIM", "1");
  zoltan.Set_Num_Obj_Fn(count, &to_divide);
  zoltan.Set_Obj_List_Fn(list, &to_divide);
  zoltan.Set_Num_Geom_Fn(dimensions, &to_divide);
  zoltan.Set_Geom_Fn(place, &to_divide);
  return zoltan;
}

// The data of a cloud that hold for all points, without points.
PointCloud emptied(const PointCloud& cloud) {
  PointCloud result;
  result.at = cloud.at;
  result.has_shared_nodes = cloud.has_shared_nodes;
  result.block_names = cloud.block_names;
  result.set_names = cloud.set_names;
  return result;
}

// Data for each rank, one rank after the other; shapes and shared nodes only if there are any.
struct Load {
  std::vector<Parcel> parcels;
  std::vector<ShapeNumbers> shapes;
  std::vector<std::int64_t> shared_nodes;
};

// Numbers of each that go to, or come from, each rank.
struct Counts {
  std::vector<std::int64_t> parcels, shapes, shared_nodes;

  explicit Counts(int ranks) : parcels(ranks, 0), shapes(parcels), shared_nodes(parcels) {}
  void add(int rank, const Parcel& parcel) {
    ++parcels[rank];
    shapes[rank] += parcel.has_shape;
    shared_nodes[rank] += parcel.shared_nodes;
  }
};

// Moves points without Zoltan, whose messages are limited to 2 GB.
PointCloud migrated(const PointCloud& cloud, const std::vector<int>& ranks, const Communicator& communicator) {
  std::vector<int> order(cloud.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&ranks](int i) { return ranks[i]; });
  Load leaving;
  Counts to(communicator.size()), from(communicator.size());
  for (const int i : order) {
    leaving.parcels.push_back(packed(cloud, i));
    to.add(ranks[i], leaving.parcels.back());
    if (!cloud.shapes.empty()) leaving.shapes.push_back(numbers_of(cloud.shapes[i]));
    if (!cloud.shared_nodes.empty()) {
      leaving.shared_nodes.insert(leaving.shared_nodes.end(), cloud.shared_nodes[i].begin(),
                                  cloud.shared_nodes[i].end());
    }
  }
  const auto sent = [&]<class T>(const std::vector<T>& values, std::vector<std::int64_t> Counts::*which) {
    return exchange(communicator, std::span<const T>(values), to.*which, from.*which);
  };
  from.parcels = counts_from_ranks(communicator, to.parcels);
  const std::vector<Parcel> parcels = sent(leaving.parcels, &Counts::parcels);
  std::size_t next = 0;
  for (int rank = 0; rank < communicator.size(); ++rank) {
    for (const std::size_t end = next + from.parcels[rank]; next < end; ++next) {
      from.shapes[rank] += parcels[next].has_shape;
      from.shared_nodes[rank] += parcels[next].shared_nodes;
    }
  }
  const std::vector<ShapeNumbers> shapes = sent(leaving.shapes, &Counts::shapes);
  const std::vector<std::int64_t> shared_nodes = sent(leaving.shared_nodes, &Counts::shared_nodes);
  PointCloud arrived = emptied(cloud);
  auto shared_node = shared_nodes.begin();
  for (const Parcel& parcel : parcels) {
    append(arrived, parcel);
    if (parcel.has_shared_nodes)
      arrived.shared_nodes.emplace_back(shared_node, shared_node + parcel.shared_nodes),
          shared_node += parcel.shared_nodes;
  }
  for (const ShapeNumbers& numbers : shapes) arrived.shapes.push_back(shape_of(numbers));
  return arrived;
}

// The index of a cell of the 2²¹ cube along Hilbert's curve (Skilling, "Programming the Hilbert curve", 2004).
std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x) {
  constexpr int bits = 21;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t swap = x[i] & q ? 0 : (x[0] ^ x[i]) & (q - 1);
      x[0] ^= x[i] & q ? q - 1 : swap;
      x[i] ^= swap;
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t gray = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    if (x[2] & q) gray ^= q - 1;
  }
  std::uint64_t key = 0;
  for (int bit = bits - 1; bit >= 0; --bit) {
    for (const std::uint32_t coordinate : x) key = key << 1 | ((coordinate ^ gray) >> bit & 1u);
  }
  return key;
}

// The median of the spacings, m.
double common_spacing(const PointCloud& cloud) {
  std::vector<double> spacings = cloud.spacings;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

// The width of the cells of the curve, m: a spacing halved as often as the cube permits. So the curve visits all
// points of a cube of two spacings, of four, … before the next one, and consecutive points are neighbors in all
// directions.
double cell_width(const PointCloud& cloud, double size) {
  const double smallest = std::max(size, 1e-300) / ((1 << 21) - 2), spacing = common_spacing(cloud);
  return spacing > smallest ? std::ldexp(spacing, -static_cast<int>(std::log2(spacing / smallest))) : smallest;
}

std::vector<int> along_curve(const PointCloud& cloud) {
  if (cloud.size() == 0) return {};
  Eigen::AlignedBox3d box;
  for (const Vector& X : cloud.positions) box.extend(X);
  const double width = cell_width(cloud, box.sizes().maxCoeff());
  // Half a cell of offset, so that round-off does not decide the cells of points on a lattice.
  const Vector origin = box.min() - Vector::Constant(0.5 * width);
  std::vector<std::pair<std::uint64_t, std::int64_t>> keys;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector place = (cloud.positions[i] - origin) / width;
    const auto cell = place.cast<std::uint32_t>();
    keys.emplace_back(hilbert_key({cell[0], cell[1], cell[2]}), cloud.ids[i]);
  }
  std::vector<int> order(cloud.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return keys[a] < keys[b]; });
  return order;
}

// Zoltan's messages, some 100 bytes per point, are limited to 2 GB.
void check_size(const PointCloud& cloud, const Communicator& communicator) {
  constexpr double most = 16e6;
  const double largest = communicator.max(static_cast<double>(cloud.size()));
  if (largest <= most) return;
  raise_together(communicator,
                 "a rank has " + std::to_string(static_cast<std::int64_t>(largest)) +
                     " points of the mesh, more than Zoltan can spread over the ranks; expected at most " +
                     std::to_string(static_cast<std::int64_t>(most)) + ": take more ranks");
}

}  // namespace

std::vector<int> bisected(const PointCloud& cloud, const std::vector<double>& costs, const Vector& lengths,
                          const Communicator& communicator) {
  std::vector<int> ranks(cloud.size(), communicator.rank());
  if (communicator.size() == 1) return ranks;
  check_size(cloud, communicator);
  PointsToDivide to_divide{cloud, costs, lengths};
  Zoltan zoltan = started_zoltan(communicator, to_divide);
  int changed, gid_size, lid_size, imports, exports;
  ZOLTAN_ID_PTR import_gids, import_lids, export_gids, export_lids;
  int *import_ranks, *import_parts, *export_ranks, *export_parts;
  require(zoltan.LB_Partition(changed, gid_size, lid_size, imports, import_gids, import_lids, import_ranks,
                              import_parts, exports, export_gids, export_lids, export_ranks, export_parts),
          "partition the points");
  for (int k = 0; k < exports; ++k) ranks[export_lids[k]] = export_ranks[k];
  Zoltan::LB_Free_Part(&import_gids, &import_lids, &import_ranks, &import_parts);
  Zoltan::LB_Free_Part(&export_gids, &export_lids, &export_ranks, &export_parts);
  return ranks;
}

PointCloud moved(const PointCloud& cloud, const std::vector<int>& ranks, const Communicator& communicator) {
  const PointCloud mine = communicator.size() == 1 ? cloud : migrated(cloud, ranks, communicator);
  return reordered(mine, along_curve(mine));
}

PointCloud partitioned(const PointCloud& cloud, const Communicator& communicator, const PartitionWeights& weights) {
  std::vector<double> costs(cloud.size(), 1);
  for (std::size_t i = 0; i < costs.size() && !weights.costs.empty(); ++i) costs[i] = weights.costs[cloud.blocks[i]];
  return moved(cloud, bisected(cloud, costs, weights.lengths, communicator), communicator);
}

PointCloud reordered(const PointCloud& cloud, const std::vector<int>& order) {
  PointCloud result = emptied(cloud);
  for (const int i : order) append(result, cloud, i);
  return result;
}

}  // namespace strut
