#include "topology/neighbors/candidates.hpp"

namespace strut {

Mirrored mirrored(std::vector<Mirror> mirrors, const std::vector<Period>& periods, const PointCloud& cloud,
                  const std::vector<BlockBonds>& bonds, double reach, const Communicator& communicator) {
  Mirrored result{.mirrors = std::move(mirrors), .periods = periods};
  if (!periods.empty()) {
    result.all = common_box(box_around(cloud.positions), communicator);
    result.images = Images(periods, reach);
    return result;
  }
  for (const Mirror& mirror : result.mirrors) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (bonds[cloud.blocks[i]].body == mirror.body) box.extend(cloud.positions[i]);
    }
    result.boxes.push_back(common_box(box, communicator));
  }
  result.images = Images(result.mirrors, result.boxes, reach);
  return result;
}

std::vector<Offered> offered(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const Mirrored& mirrored,
                             double reach) {
  std::vector<Offered> all;
  for (int i = 0; i < static_cast<int>(cloud.size()); ++i) all.push_back({i, 0, cloud.positions[i]});
  for (std::size_t m = 0; m < mirrored.mirrors.size(); ++m) {
    const int body = mirrored.mirrors[m].body;
    if (m > 0 && mirrored.mirrors[m - 1].body == body) continue;  // mirrors are sorted by body
    for (int i = 0; i < static_cast<int>(cloud.size()); ++i) {
      if (bonds[cloud.blocks[i]].body != body) continue;
      for (const int image : mirrored.images.of_body(body)) {
        const Vector place = mirrored.images[image](cloud.positions[i]);
        if (mirrored.boxes[m].squaredExteriorDistance(place) <= reach * reach) all.push_back({i, image, place});
      }
    }
  }
  for (const int image : mirrored.periods.empty() ? std::vector<int>() : mirrored.images.of_body(0)) {
    for (int i = 0; i < static_cast<int>(cloud.size()); ++i) {
      const Vector place = mirrored.images[image](cloud.positions[i]);
      if (mirrored.all.squaredExteriorDistance(place) <= reach * reach) all.push_back({i, image, place});
    }
  }
  return all;
}

namespace {

// A point that another rank may need, in the form in which it is sent.
struct Candidate {
  double position[3];
  double volume, horizon;
  std::int64_t id;   // for an image: Images::id
  int block, owner;  // owner: the rank
};

std::vector<Candidate> candidates(const PointCloud& cloud, const std::vector<double>& horizons,
                                  const std::vector<Offered>& offers, double reach, const Communicator& communicator) {
  std::vector<Candidate> mine;
  std::vector<Vector> places;
  std::vector<char> is_image;
  for (const auto& [i, image, X] : offers) {
    mine.push_back({{X[0], X[1], X[2]},
                    cloud.volumes[i],
                    horizons[i],
                    Images::id(cloud.ids[i], image),
                    cloud.blocks[i],
                    communicator.rank()});
    places.push_back(X);
    is_image.push_back(image > 0);
  }
  return received(cloud, places, mine, is_image, reach, communicator);
}

}  // namespace

std::vector<double> horizons_of(const PointCloud& cloud, const std::vector<BlockBonds>& bonds) {
  std::vector<double> horizons;
  horizons.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const BlockBonds& block = bonds[cloud.blocks[i]];
    horizons.push_back(block.search_factor() * block.horizon_at(cloud.spacings[i]));
  }
  return horizons;
}

CandidatePool candidates_of(const PointCloud& cloud, const std::vector<double>& horizons,
                            const std::vector<BlockBonds>& bonds, const std::vector<Offered>& offers, double reach,
                            const Communicator& communicator) {
  CandidatePool pool{cloud.positions, cloud.volumes, cloud.ids, horizons, {}, {}};
  const auto add_block = [&](int block) {
    pool.bodies.push_back(bonds[block].body);
    pool.asks.push_back(bonds[block].touching ? 2 : bonds[block].visible_only ? 1 : 0);
    pool.deltas.push_back(pool.horizons[pool.deltas.size()] / bonds[block].search_factor());
  };
  for (const int block : cloud.blocks) add_block(block);
  for (const Candidate& c : candidates(cloud, horizons, offers, reach, communicator)) {
    pool.positions.emplace_back(c.position[0], c.position[1], c.position[2]);
    pool.volumes.push_back(c.volume);
    pool.ids.push_back(c.id);
    pool.horizons.push_back(c.horizon);
    pool.owners.push_back(c.owner);
    add_block(c.block);
  }
  return pool;
}

}  // namespace strut
