"""Points and ghosts of each rank from 2 to 4096 ranks, by cutting a real cloud as a run would, without a run."""
import numpy as np

from picture_parts.result import Result

MOST_CUTS = 12  # 4096 ranks


def near(points, box, horizon):
    low, high = box
    return points[np.all((points >= low - horizon) & (points <= high + horizon), axis=1)]


def cut(own, others, horizon, level, table):
    """`own`: the points of a part; `others`: those within the horizon of its box, without its own."""
    table[level].append((len(own), len(others)))
    if level == MOST_CUTS or len(own) < 2:
        return
    low, high = own.min(axis=0), own.max(axis=0)
    axis = int(np.argmax(high - low))
    order = np.argpartition(own[:, axis], len(own) // 2)
    halves = own[order[:len(own) // 2]], own[order[len(own) // 2:]]
    for mine, sibling in (halves, halves[::-1]):
        box = mine.min(axis=0), mine.max(axis=0)
        cut(mine, np.concatenate([near(others, box, horizon), near(sibling, box, horizon)]), horizon, level + 1, table)


def table_of_ghosts(path, horizon, with_gradients):
    """Ghosts are counted as all points within the horizon of a rank's box: no fewer than there are. Bytes are what a rank
    receives a step: places (24) and force states (96), and the records of the mean gradient (96)."""
    points = Result(path).reference
    bytes_a_ghost = 24 + 96 + (96 if with_gradients else 0)
    table = [[] for _ in range(MOST_CUTS + 1)]
    cut(np.asarray(points, dtype=np.float64), np.empty((0, 3)), horizon, 0, table)
    print("| ranks | points a rank | ghosts: mean, most | ghosts a point | received a rank and step, most |")
    print("|---|---|---|---|---|")
    for parts in table[1:]:
        own, ghosts = np.array(parts).T
        print(f"| {len(parts)} | {own.mean():,.0f} | {ghosts.mean():,.0f}, {ghosts.max():,} | "
              f"{ghosts.sum() / own.sum():.2f} | {ghosts.max() * bytes_a_ghost / 1e6:,.2f} MB |")
