"""A learner of your own, here ridge regression, and a model made from weights."""

import dmpcpp
import numpy as np

time = np.linspace(0, 1, 100)  # s
demonstrations = [dmpcpp.Demonstration(time, height * np.sin(np.pi * time) ** 2) for height in (0.2, 0.3, 0.4)]


def ridge(basis: dmpcpp.GaussianBasis, targets: list[dmpcpp.ForcingTarget]) -> np.ndarray:
    """Return the weights (N, dims) that fit all targets: features @ weights is the forcing term."""
    features = np.vstack([basis.features(target.phase) for target in targets])
    values = np.vstack([target.value for target in targets])
    return np.linalg.solve(features.T @ features + 1e-9 * np.eye(basis.count), features.T @ values)


bump = dmpcpp.Dmp.fit(demonstrations, basis_count=40, learner=ridge)

# The motion is linear in its weights: half of them are half the bump.
half = bump.with_weights(0.5 * bump.weights)
heights = [model.rollout().position.max() for model in (bump, half)]
print("the mean bump is", heights[0], "m high, half of its weights make", heights[1], "m")
assert np.allclose(heights, [0.3, 0.15], atol=1e-3)
