"""Well-known searches in NumPy, to stand beside the library's own in :func:`lyrefit.compare`.

Experimental: may change in a minor version.

>>> from lyrefit import searches
>>> lyrefit.compare("data/rtc_france", algorithms=["mlo", "de", searches.cma_es, searches.grey_wolf])

Each is called as ``search(objective, lower, upper, options)`` and returns its best point. It works in the unit box,
spends ``population * (iterations + 1)`` evaluations and depends on ``seed`` and ``run`` alone. They are also models of how
a search of one's own is written.
"""

import numpy as np

__all__ = ["cma_es", "grey_wolf", "particle_swarm", "simulated_annealing"]


def _begin(objective, lower, upper, options):
    """The objective on points of the unit box, a random stream, the first population and its values.

    The population is the one from which the library's searches start.
    """
    random = np.random.default_rng([options["seed"], options["run"]])
    points = (options["start"] - lower) / (upper - lower)

    def value(unit):
        return objective(lower + unit * (upper - lower))

    return value, random, points, value(points)


def cma_es(objective, lower, upper, options):
    """Covariance matrix adaptation: Hansen and Ostermeier (2001), doi:10.1162/106365601750190398.

    Begins at the best of a random population with a step of 0.3 of the box; constants as in Hansen's tutorial
    (arXiv:1604.00772). Points outside the box are put on its faces.
    """
    value, random, points, values = _begin(objective, lower, upper, options)
    size, n = points.shape
    weights = np.log((size + 1) / 2) - np.log(np.arange(1, size // 2 + 1))
    weights /= weights.sum()
    mu = 1 / np.sum(weights**2)
    c_step, c_path = (mu + 2) / (n + mu + 5), (4 + mu / n) / (n + 4 + 2 * mu / n)
    damping = 1 + 2 * max(0, np.sqrt((mu - 1) / (n + 1)) - 1) + c_step
    c_one = 2 / ((n + 1.3) ** 2 + mu)
    c_mu = min(1 - c_one, 2 * (mu - 2 + 1 / mu) / ((n + 2) ** 2 + mu))
    normal_length = np.sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n))
    best, least = points[values.argmin()], values.min()
    mean, step, covariance = best, 0.3, np.eye(n)
    path_step, path = np.zeros(n), np.zeros(n)
    for generation in range(1, options["iterations"] + 1):
        spread, axes = np.linalg.eigh(covariance)
        spread = np.sqrt(np.maximum(spread, 1e-20))
        points = np.clip(mean + step * (random.standard_normal((size, n)) * spread) @ axes.T, 0, 1)
        values = value(points)
        if values.min() < least:
            best, least = points[values.argmin()], values.min()
        moves = (points[np.argsort(values)[: len(weights)]] - mean) / step
        move = weights @ moves
        mean = mean + step * move
        path_step = (1 - c_step) * path_step + np.sqrt(c_step * (2 - c_step) * mu) * (axes / spread) @ (axes.T @ move)
        length = np.linalg.norm(path_step)
        steady = length < (1.4 + 2 / (n + 1)) * normal_length * np.sqrt(1 - (1 - c_step) ** (2 * generation))
        path = (1 - c_path) * path + steady * np.sqrt(c_path * (2 - c_path) * mu) * move
        covariance = ((1 - c_one - c_mu) * covariance + c_mu * (moves.T * weights) @ moves + c_one * (
            np.outer(path, path) + (1 - steady) * c_path * (2 - c_path) * covariance))
        step *= np.exp(min(1, c_step / damping * (length / normal_length - 1)))
    return lower + best * (upper - lower)


def particle_swarm(objective, lower, upper, options):
    """Particle swarm with constriction: Clerc and Kennedy (2002), doi:10.1109/4235.985692.

    A particle stops at the faces of the box.
    """
    value, random, points, values = _begin(objective, lower, upper, options)
    own, own_values, speed = points, values, np.zeros_like(points)
    for _ in range(options["iterations"]):
        leader = own[own_values.argmin()]
        to_own, to_leader = random.random((2, *points.shape))
        speed = 0.7298 * (speed + 2.05 * to_own * (own - points) + 2.05 * to_leader * (leader - points))
        moved = points + speed
        points = np.clip(moved, 0, 1)
        speed[points != moved] = 0
        values = value(points)
        own = np.where((values < own_values)[:, np.newaxis], points, own)
        own_values = np.minimum(values, own_values)
    return lower + own[own_values.argmin()] * (upper - lower)


def grey_wolf(objective, lower, upper, options):
    """Grey wolf optimizer: Mirjalili, Mirjalili and Lewis (2014), doi:10.1016/j.advengsoft.2013.12.007."""
    value, random, points, values = _begin(objective, lower, upper, options)
    leaders, leading = points[np.argsort(values)[:3]], np.sort(values)[:3]
    for iteration in range(options["iterations"]):
        reach = 2 - 2 * iteration / options["iterations"]
        a, c = random.random((2, 3, *points.shape))
        distance = np.abs(2 * c * leaders[:, np.newaxis] - points)
        points = np.clip((leaders[:, np.newaxis] - reach * (2 * a - 1) * distance).mean(axis=0), 0, 1)
        values = np.concatenate([leading, value(points)])
        order = np.argsort(values, kind="stable")[:3]
        leaders, leading = np.concatenate([leaders, points])[order], values[order]
    return lower + leaders[0] * (upper - lower)


def simulated_annealing(objective, lower, upper, options):
    """Simulated annealing with steps of its own in each coordinate: Corana et al. (1987), doi:10.1145/29380.29864.

    Begins at the best of a random population; the temperature falls from the least value found there to 1e-4 of it. The
    steps are adapted after every 20 moves of each coordinate, so that half of the moves are taken.
    """
    value, random, points, values = _begin(objective, lower, upper, options)
    point, now = points[values.argmin()].copy(), values.min()
    best, least, start = point.copy(), now, now
    n, evaluations = len(lower), options["population"] * options["iterations"]
    steps, taken = np.ones(n), np.zeros(n)
    for evaluation in range(evaluations):
        at = evaluation % n
        moved = point.copy()
        moved[at] += steps[at] * random.uniform(-1, 1)
        if not 0 <= moved[at] <= 1:
            moved[at] = random.random()
        found, luck = value(moved), random.random()
        if found <= now or luck < np.exp((now - found) / (start * 1e-4 ** (evaluation / evaluations))):
            point, now = moved, found
            taken[at] += 1
            if now < least:
                best, least = point.copy(), now
        if (evaluation + 1) % (20 * n) == 0:
            share = taken / 20
            steps *= np.where(share > 0.6, 1 + 5 * (share - 0.6), np.where(share < 0.4, 1 / (1 + 5 * (0.4 - share)), 1))
            steps, taken = np.minimum(steps, 1), np.zeros(n)
    return lower + best * (upper - lower)
