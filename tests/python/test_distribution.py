"""Distributions over several demonstrations: conditioned, drawn from, judged and saved."""

import copy
import pickle

import dmpcpp
import numpy as np
import pytest
from dmpcpp import Given, InvalidArgument, PoseDistribution, so3

TIME = np.linspace(0, 2, 90)
SHARE = TIME / 2


def pose_takes(count=6, seed=0):
    """Hands that reach and turn, each a little otherwise."""
    rng = np.random.default_rng(seed)
    takes = []
    for _ in range(count):
        aside, twist = rng.normal(size=(2, 3))
        poses = np.tile(np.eye(4), (len(TIME), 1, 1))
        poses[:, :3, 3] = np.c_[0.3 * SHARE, 0.2 * np.sin(3 * SHARE), 0.1 + 0 * SHARE] + 0.03 * SHARE[:, None] * aside
        poses[:, :3, :3] = [so3.exp(0.1 * s * twist) @ so3.exp(s * np.array([1.0, 0.5, 0.2])) for s in SHARE]
        takes.append(dmpcpp.PoseDemonstration(TIME, poses))
    return takes


TAKES = pose_takes()
LEARNED = PoseDistribution.fit(TAKES)
DISTRIBUTIONS = {
    "DmpDistribution": dmpcpp.DmpDistribution.fit([take.position for take in TAKES]),
    "OrientationDistribution": dmpcpp.OrientationDistribution.fit([take.orientation for take in TAKES]),
    "PoseDistribution": LEARNED,
    "PoseGripperDistribution": dmpcpp.PoseGripperDistribution.fit(
        [dmpcpp.PoseGripperDemonstration(TIME, take.pose, take.pose[:, 0, 3]) for take in TAKES]
    ),
}
every_kind = pytest.mark.parametrize("kind", DISTRIBUTIONS)


@every_kind
def test_a_distribution_is_saved_pickled_and_shown(kind, tmp_path):
    one = DISTRIBUTIONS[kind]
    dmpcpp.save(one, tmp_path / "model.json")
    for again in (dmpcpp.load(tmp_path / "model.json"), pickle.loads(pickle.dumps(one)), copy.deepcopy(one)):
        assert type(again).__name__ == kind
        assert np.array_equal(again.weights, one.weights)
        assert np.array_equal(again.covariance, one.covariance)
    assert repr(one) == f"<{kind}: of 6 demonstrations, 14 control points, 2 s>"
    assert one.covariance.shape == (14 * one.dimension,) * 2


@every_kind
def test_its_mean_is_a_primitive(kind):
    one = DISTRIBUTIONS[kind]
    model = one.mean(basis_count=40)
    assert type(model).__name__ == kind.replace("Distribution", "Dmp").replace("DmpDmp", "Dmp")
    assert model.options.basis_count == 40
    assert model.duration == pytest.approx(2.0)


def test_a_dict_gives_points_by_their_phases():
    place = LEARNED.rollout(3).pose[1].copy()
    place[:3, 3] += [0.02, -0.01, 0.03]
    place[:3, :3] = so3.exp([0.1, 0.2, -0.1]) @ place[:3, :3]
    found = LEARNED.condition({0.5: place, 1.0: [0.32, 0.05, 0.1]})
    motion = found.rollout(3)
    assert np.allclose(motion.pose[1], place, atol=1e-9)
    assert np.allclose(motion.pose[2, :3, 3], [0.32, 0.05, 0.1], atol=1e-9)  # whatever the rotation
    assert found.spread(3).covariance[1] == pytest.approx(0, abs=1e-18)


def test_conditioning_is_that_of_numpy():
    one = DISTRIBUTIONS["DmpDistribution"]
    noise = np.diag([1e-4, 2e-4, 3e-4])
    place = one.rollout(5).position[2] + [0.01, 0.02, -0.01]
    found = one.condition([Given(0.5, place, covariance=noise)])
    # The rows of the weights at 0.5, by conditioning on nothing but their effect on the mean.
    spread = one.spread(5).covariance[2]
    gain = spread @ np.linalg.inv(spread + noise)
    assert found.rollout(5).position[2] == pytest.approx(one.rollout(5).position[2] + gain @ [0.01, 0.02, -0.01])
    assert found.spread(5).covariance[2] == pytest.approx(spread - gain @ spread, abs=1e-15)


def test_what_was_seen_of_a_take_says_how_it_goes_on():
    unseen = pose_takes(1, seed=9)[0]
    part = dmpcpp.PoseDemonstration(TIME[:40], unseen.pose[:40])
    before = np.linalg.norm(LEARNED.rollout(90).pose[-1, :3, 3] - unseen.pose[-1, :3, 3])
    after = np.linalg.norm(LEARNED.continued(part).rollout(90).pose[-1, :3, 3] - unseen.pose[-1, :3, 3])
    assert after < 0.9 * before
    sharper = LEARNED.continued(part, noise=[1e-4, 1e-3])
    assert np.trace(sharper.covariance) < np.trace(LEARNED.continued(part).covariance)
    with pytest.raises(InvalidArgument, match="part: ends at"):
        LEARNED.continued(unseen, duration=1.0)


def test_how_far_from_the_demonstrations_something_is():
    mean = LEARNED.rollout(3).pose[1]
    far = mean.copy()
    far[:3, 3] += 0.2
    assert LEARNED.distance(Given(0.5, mean)) == pytest.approx(0, abs=1e-6)
    assert LEARNED.distance(Given(0.5, far)) > 4
    other = [dmpcpp.PoseDemonstration(TIME, np.array([far] * len(TIME)))]
    assert LEARNED.log_likelihood(TAKES[0]) > LEARNED.log_likelihood(other[0])


def test_one_seed_gives_one_motion():
    assert np.array_equal(LEARNED.sample(seed=4).pose, LEARNED.sample(seed=4).pose)
    assert not np.array_equal(LEARNED.sample(seed=4).pose, LEARNED.sample(seed=5).pose)


def test_stiffness_and_damping_take_one_number_or_one_an_axis():
    most = [500.0] * 3 + [20.0] * 3
    stiffness = LEARNED.stiffness(1.0, most, [0.01] * 3 + [0.05] * 3)
    assert np.all(np.linalg.eigvalsh(np.diag(most) - stiffness) > -1e-9)
    assert np.all(np.linalg.eigvalsh(stiffness) > 0)
    damping = dmpcpp.damping_of(stiffness, zeta=1.0)
    assert damping @ damping == pytest.approx(4 * stiffness)
    one = DISTRIBUTIONS["DmpDistribution"]
    assert one.stiffness(0.5, 100.0, 0.01) == pytest.approx(one.stiffness(0.5, [100.0] * 3, [0.01] * 3))


def test_distributions_are_blended():
    place = LEARNED.rollout(3).pose[2].copy()
    place[:3, 3] += [0.01, 0.0, 0.0]
    other = LEARNED.condition([Given(1.0, place, covariance=1e-6 * np.eye(6))])
    both = dmpcpp.blend([LEARNED, other], [0.5, 0.5])
    ends = [d.rollout(3).pose[2, 0, 3] for d in (LEARNED, both, other)]
    assert ends[0] < ends[1] <= ends[2] + 1e-9
    with pytest.raises(InvalidArgument, match=r"weights: 1 numbers, expected 2"):
        dmpcpp.blend([LEARNED, other], [1.0])


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({0.5: np.eye(3)}, r"given\[0\].point"),
        ({0.5: "here"}, r"given\[0\].point: of the wrong type, expected \(4, 4\)"),
        ({1.5: np.eye(4)}, r"given\[0\].phase: 1.5"),
        ([Given(0.5, np.eye(4), velocity=[1, 2])], r"given\[0\].velocity: 2 numbers, expected 6"),
        ([Given(0.5)], "neither point nor velocity"),
        ([Given(0.5, np.eye(4)), Given(0.5, np.eye(4))], r"given\[1\]: nothing is left open"),
        ([Given(0.5, np.eye(4), covariance=-np.eye(6))], r"given\[0\].covariance: not symmetric and positive"),
        ([Given(0.5, np.eye(4), axes=[6])], r"given\[0\].axes: 6"),
    ],
)
def test_what_cannot_be_given_is_refused_by_its_name(given, words):
    with pytest.raises(InvalidArgument, match=words):
        LEARNED.condition(given)


def test_takes_that_do_not_belong_together_are_refused():
    backwards = dmpcpp.PoseDemonstration(TIME, TAKES[0].pose[::-1])
    with pytest.raises(InvalidArgument, match=r"demonstrations\[2\]: goes another way than the others"):
        PoseDistribution.fit([*TAKES[:2], backwards, *TAKES[3:]])
    with pytest.raises(InvalidArgument, match="expected at least 2"):
        PoseDistribution.fit(TAKES[:1])


def test_recorded_pouring_is_predicted_from_what_is_given(recorded):
    takes = []
    for take in np.load(recorded / "robotasks_clfd" / "pouring.npy")[:, ::9]:
        quaternions = take[:, 3:] / np.linalg.norm(take[:, 3:], axis=1)[:, None]
        takes.append(
            dmpcpp.PoseDemonstration.from_quaternions(
                np.linspace(0, 1, len(take)), 0.01 * take[:, :3], quaternions, "wxyz"
            )
        )
    plain, helped = [], []
    for j, unseen in enumerate(takes):
        one = PoseDistribution.fit(takes[:j] + takes[j + 1 :])
        count = len(unseen.time)
        given = [
            Given(s, unseen.pose[round(s * (count - 1))], covariance=one.observation_covariance(s))
            for s in (0.0, 0.5, 1.0)
        ]
        for errors, found in ((plain, one), (helped, one.condition(given))):
            errors.append(np.sqrt(np.mean((found.rollout(count).pose - unseen.pose)[:, :3, 3] ** 2)))
    assert np.mean(helped) < 0.8 * np.mean(plain)
