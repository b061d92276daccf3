"""The models and runs as Python sees them; the numerics are tested in C++, against an independent oracle here."""

import copy
import pickle
import threading

import dmpcpp
import numpy as np
import pytest
from dmpcpp import Dmp, InvalidArgument, OrientationDmp, PoseDmp
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation


def helix(count: int = 201) -> dmpcpp.Demonstration:
    """The source's: x = sin, y = cos, z linear."""
    k = np.arange(count) * 200 / (count - 1)
    return dmpcpp.Demonstration(k * 0.005, np.c_[np.sin(0.05 * k), np.cos(0.05 * k), 2.0 * k])


def euler_angles(time: np.ndarray) -> np.ndarray:
    return np.c_[0.8 * np.sin(time), 0.5 * np.cos(time), 0.6 * time]


def poses(count: int = 300, duration: float = 3.0) -> dmpcpp.PoseDemonstration:
    time = np.linspace(0, duration, count)
    pose = np.tile(np.eye(4), (count, 1, 1))
    pose[:, :3, :3] = Rotation.from_euler("ZYX", euler_angles(time)).as_matrix()
    pose[:, :3, 3] = 0.1 * np.c_[np.sin(2 * time), np.cos(2 * time), time]
    return dmpcpp.PoseDemonstration(time, pose)


def test_positions_and_orientations_and_both_as_matrices_come_back():
    demonstration = helix()
    rollout = Dmp.fit(demonstration).rollout(dt=0.005)
    assert np.abs(rollout.position - demonstration.position).max() < 0.01
    time = np.linspace(0, 3, 300)
    turning = dmpcpp.OrientationDemonstration.from_euler(time, euler_angles(time), "ZYX")
    turned = OrientationDmp.fit(turning).rollout_at(time).rotation
    expected = Rotation.from_euler("ZYX", euler_angles(time))
    assert (Rotation.from_matrix(turned) * expected.inv()).magnitude().max() < 1e-4
    both = poses()
    assert np.abs(PoseDmp.fit(both).rollout_at(both.time).pose - both.pose).max() < 1e-4


def test_the_equation_of_motion_is_the_documented_one():
    """scipy integrates tau zd = alpha (beta (g - y) - z) + f, tau yd = z from the model's public numbers."""
    model = Dmp.fit(helix(), basis_count=40, alpha=20.0, beta=4.0)
    advance = model.parameters.advance
    tau, alpha, beta = 1.7, 20.0, 4.0
    away = np.array([0.3, -0.2, 5.0])
    goal = model.goal + away

    def rate(t, state):
        y, z = state[:3], state[3:]
        psi = model.activations([t / tau], normalised=True)[0]
        force = model.forcing([t / tau])[0] + np.exp(-np.log(100) * t / tau) * (psi @ advance) * away
        return np.r_[z, alpha * (beta * (goal - y) - z) + force] / tau

    start = model.rollout_at([0.0])
    state = np.r_[model.start, model.duration * start.velocity[0]]
    times = np.linspace(0, tau, 18)
    exact = solve_ivp(rate, (0, tau), state, t_eval=times, rtol=1e-11, atol=1e-11).y[:3].T
    rollout = model.rollout_at(times, goal=goal, duration=tau)
    assert np.abs(rollout.position - exact).max() < 1e-5 * 400


def test_the_forcing_term_is_x_times_the_normalised_sum():
    model = Dmp.fit(helix(), basis_count=30, regression="lwr")
    phase = np.linspace(0, 1, 50)
    psi = np.exp(-np.log(2) * (29 * phase[:, None] - np.arange(30)) ** 2)
    x = np.exp(-np.log(100) * phase)[:, None]
    expected = x * (psi @ model.weights) / psi.sum(axis=1, keepdims=True)
    assert np.allclose(model.forcing(phase), expected, rtol=1e-12)
    assert np.allclose(model.activations(phase), psi, atol=1e-15)
    assert np.allclose(model.activations(phase, normalised=True).sum(axis=1), 1.0)


def test_a_rollout_has_the_documented_times_and_shapes():
    rollout = PoseDmp.fit(poses()).rollout(duration=2.0, dt=0.01)
    assert rollout.time.shape == (201,) and rollout.time[-1] == pytest.approx(2.0)
    assert rollout.pose.shape == (201, 4, 4) and rollout.twist.shape == (201, 6)
    assert rollout.position.shape == (201, 3) and rollout.rotation.shape == (201, 3, 3)
    for array in (rollout.time, rollout.pose, rollout.twist, rollout.position, rollout.rotation):
        assert array.dtype == np.float64 and array.flags.c_contiguous and array.flags.owndata


def test_a_run_is_true_while_it_runs_and_false_when_it_has_finished():
    model = Dmp.fit(helix())
    run = dmpcpp.Run(model)
    steps = 0
    while run.step(0.01):
        steps += 1
    assert steps == 99 and run.status == dmpcpp.Status.finished
    assert np.allclose(run.position, model.rollout(dt=0.01).position[-1])
    other = copy.deepcopy(copy.copy(run))
    run.reset()
    assert np.allclose(run.position, model.start) and not np.allclose(other.position, model.start)


def test_a_goal_and_a_duration_can_be_changed_on_the_way():
    run = dmpcpp.PoseRun(PoseDmp.fit(poses()))
    for _ in range(100):
        run.step(0.01)
    goal = run.goal.copy()
    goal[:3, 3] += 0.1
    run.goal = goal
    run.duration = 5.0
    while run.step(0.01):
        pass
    for _ in range(500):
        run.step(0.01)
    assert np.abs(run.pose - goal).max() < 1e-4


def test_a_refused_call_changes_nothing():
    run = dmpcpp.Run(Dmp.fit(helix()))
    run.step(0.1)
    position, goal = run.position, run.goal
    with pytest.raises(InvalidArgument, match="goal"):
        run.goal = [np.nan, 0, 0]
    with pytest.raises(InvalidArgument, match="dt: -0.1"):
        run.step(-0.1)
    with pytest.raises(InvalidArgument, match="duration"):
        run.duration = 0.0
    with pytest.raises(InvalidArgument, match="start_from"):
        run.start_from([0, 0], [0, 0, 0])
    assert (run.position == position).all() and (run.goal == goal).all()


def test_options_are_fields_keywords_or_an_object_and_enumerators_go_by_name():
    demonstration = helix()
    options = dmpcpp.DmpOptions(basis_count=20, regression="ridge")
    a = Dmp.fit(demonstration, options)
    b = Dmp.fit(demonstration, basis_count=20, regression=dmpcpp.Regression.ridge)
    assert (a.weights == b.weights).all() and a.weights.shape == (20, 3)
    assert Dmp.fit(demonstration, options, basis_count=25).options.basis_count == 25
    assert a.options.beta == 6.25 and a.options.regression is dmpcpp.Regression.ridge
    assert dmpcpp.DmpOptions.source().scaling is dmpcpp.Scaling.per_axis


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"bases": 3}, "'bases' is unknown"),
        ({"regression": "gpr"}, "'gpr' is unknown, expected one of lwr, ridge"),
        ({"alpha": "large"}, "options.alpha: 'large' is of the wrong type"),
        ({"basis_count": -1}, "options.basis_count: -1"),
        ({"alpha": np.inf}, "options.alpha: inf"),
    ],
)
def test_options_that_cannot_be_are_refused_by_name(fields, message):
    with pytest.raises(InvalidArgument, match=message):
        Dmp.fit(helix(), **fields)


def test_arrays_of_the_wrong_shape_are_refused_with_what_was_expected():
    with pytest.raises(InvalidArgument, match=r"poses: an array of shape \(5, 3, 3\), expected \(T, 4, 4\)"):
        dmpcpp.PoseDemonstration(np.arange(5.0), np.zeros((5, 3, 3)))
    with pytest.raises(InvalidArgument, match=r"times: an array of shape \(5, 1\), expected one dimension"):
        dmpcpp.Demonstration(np.zeros((5, 1)), np.zeros((5, 2)))
    with pytest.raises(InvalidArgument, match=r"positions\[3, 1\]: nan"):
        dmpcpp.Demonstration(np.arange(5.0), np.where(np.arange(10).reshape(5, 2) == 7, np.nan, 1.0))
    with pytest.raises(InvalidArgument, match=r"goal: 2 numbers, expected 3"):
        Dmp.fit(helix()).rollout(goal=[1, 2])
    reflected = np.tile(np.eye(4), (9, 1, 1))
    reflected[4, 2, 2] = -1
    with pytest.raises(InvalidArgument, match=r"poses\[4\]: det\(R\) = -1.000"):
        dmpcpp.PoseDemonstration(np.arange(9.0), reflected)


def test_models_go_through_files_and_pickles_bit_for_bit(tmp_path):
    for model in (Dmp.fit(helix()), PoseDmp.fit(poses()), OrientationDmp.fit(poses().orientation)):
        path = tmp_path / "model.json"
        dmpcpp.save(model, path)
        for again in (
            dmpcpp.load(path),
            pickle.loads(pickle.dumps(model)),
            dmpcpp.from_json(dmpcpp.to_json(model)),
        ):
            assert type(again) is type(model)
            assert (again.weights == model.weights).all()
            assert dmpcpp.to_json(again) == dmpcpp.to_json(model)
    assert [p.name for p in tmp_path.iterdir()] == ["model.json"]


def test_a_file_that_is_missing_or_no_model_says_so(tmp_path):
    with pytest.raises(dmpcpp.FileError, match=r"nowhere.json: cannot be read: No such file"):
        dmpcpp.load(tmp_path / "nowhere.json")
    (tmp_path / "text.json").write_text("hello")
    with pytest.raises(InvalidArgument, match=r"text.json: model: not readable as JSON"):
        dmpcpp.load(tmp_path / "text.json")
    with pytest.raises(dmpcpp.FileError):
        dmpcpp.save(Dmp.fit(helix()), tmp_path / "no" / "model.json")


def test_a_model_is_shared_between_threads():
    model = PoseDmp.fit(poses())
    serial = model.rollout(dt=1e-3).pose
    answers: list[np.ndarray] = []
    threads = [threading.Thread(target=lambda: answers.append(model.rollout(dt=1e-3).pose)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4 and all((answer == serial).all() for answer in answers)


def test_recorded_poses_are_reproduced(recorded):
    """Hand-guided pouring and box opening, 9 demonstrations each.

    Their orientations were recorded in steps of up to a degree, which 100 kernels cannot and should not follow.
    """
    shares, angles = [], []
    for name in ("pouring", "openbox"):
        for demonstration in np.load(recorded / "robotasks_clfd" / f"{name}.npy"):
            pose = np.tile(np.eye(4), (1000, 1, 1))
            pose[:, :3, :3] = Rotation.from_quat(demonstration[:, [4, 5, 6, 3]]).as_matrix()
            pose[:, :3, 3] = demonstration[:, :3] / 100
            shown = dmpcpp.PoseDemonstration(np.linspace(0, 4.995, 1000), pose)
            again = PoseDmp.fit(shown).rollout_at(shown.time)
            distance = np.linalg.norm(again.position - pose[:, :3, 3], axis=1)
            diagonal = np.linalg.norm(np.ptp(pose[:, :3, 3], axis=0))
            shares.append(100 * np.sqrt(np.mean(distance**2)) / diagonal)
            turn = Rotation.from_matrix(again.rotation) * Rotation.from_matrix(pose[:, :3, :3]).inv()
            angles.append(np.degrees(np.sqrt(np.mean(turn.magnitude() ** 2))))
    assert np.median(shares) <= 0.006
    assert np.median(angles) <= 0.2


@pytest.mark.parametrize(
    "fields",
    [
        {"orientation_alpha": 40.0},
        {"orientation_alpha": 40.0, "orientation_beta": 8.0},
        {"orientation_form": "log_linear"},
        {"log_branch": "principal"},
        {"kernels": "source"},
        {"overlap": 0.4},
        {"scaling": "per_axis_relative"},
        {"scaling": "rotation_dilation"},
        {"derivatives": "smooth"},
        {"integrator": "semi_implicit_euler"},
        {"force_after_end": True},
        {"goal_filter": 0.0},
        {"tempo_filter": 0.0},
        {"phase_stop": 10.0},
    ],
    ids=str,
)
def test_a_model_keeps_its_options_through_a_file_and_still_reproduces(fields):
    demonstration = poses()
    model = PoseDmp.fit(demonstration, **fields)
    for name, value in fields.items():
        found = getattr(model.options, name)
        assert (found.name if isinstance(value, str) else found) == value
    again = dmpcpp.from_json(dmpcpp.to_json(model)).rollout_at(demonstration.time)
    assert np.abs(again.position - demonstration.pose[:, :3, 3]).max() < 0.02
    assert np.abs(again.rotation - demonstration.pose[:, :3, :3]).max() < 0.1


def test_a_phase_that_is_no_phase_is_refused():
    model = Dmp.fit(helix())
    for phase in ([np.nan], [-1.0], [np.inf]):
        with pytest.raises(InvalidArgument, match=r"phase\[0\]"):
            model.forcing(phase)


def test_the_options_of_a_model_are_a_copy_that_cannot_change_it():
    time = np.linspace(0.0, 1.0, 50)
    model = dmpcpp.Dmp.fit(dmpcpp.Demonstration(time, time**2))
    before, options = model.rollout().position, model.options
    options.alpha = 99.0
    assert model.options.alpha != 99.0
    assert np.array_equal(model.rollout().position, before)


def test_values_print_what_they_are_and_options_can_be_read_back():
    options = dmpcpp.DmpOptions(basis_count=50, regression="ridge", beta=4.0)
    assert repr(options) == "DmpOptions(basis_count=50, beta=4.0, regression=Regression.ridge)"
    assert eval(repr(options), vars(dmpcpp)) == options
    assert repr(dmpcpp.DmpOptions()) == "DmpOptions()"
    time = np.linspace(0.0, 2.0, 101)
    demonstration = dmpcpp.Demonstration(time + 3.0, np.c_[np.sin(time), np.cos(time)])
    model = dmpcpp.Dmp.fit(demonstration, options)
    assert repr(demonstration) == "<Demonstration: 101 samples, 0 to 2 s>"
    assert repr(model) == "<Dmp: 50 kernels, 2 s>"
    assert repr(model.rollout(dt=0.5)) == "<Trajectory: 5 samples, 0 to 2 s, 2 dimensions>"


@pytest.mark.parametrize(
    "options",
    [
        dmpcpp.DmpOptions(basis_count=7, scaling="per_axis", orientation_alpha=12.0),
        dmpcpp.IkOptions(position_tolerance=1e-7, weight=[1, 1, 1, 0, 0, 1], backend=dmpcpp.IkBackend.kdl_lma),
        dmpcpp.FollowOptions(start=[0.1, 0.2], thorough=False),
        dmpcpp.TrackOptions(limit_pull=0.5),
    ],
    ids=lambda options: type(options).__name__,
)
def test_options_are_values_to_compare_copy_and_send_to_other_processes(options):
    assert pickle.loads(pickle.dumps(options)) == options
    assert copy.copy(options) == options == copy.deepcopy(options)
    assert options != type(options)()
    assert options != "options"
    changed = copy.copy(options)
    setattr(changed, {"DmpOptions": "passes"}.get(type(options).__name__, "position_tolerance"), 3)
    assert changed != options


def test_motions_come_out_of_a_pickle_bit_for_bit():
    time = np.linspace(0.0, 1.0, 40)
    poses = np.tile(np.eye(4), (40, 1, 1))
    poses[:, :3, 3] = np.c_[time, time**2, -time]
    poses[:, :3, :3] = [dmpcpp.so3.exp([0.3 * t, 0.1, t]) for t in time]
    demonstration = dmpcpp.PoseDemonstration(time, poses)
    motions = [
        (dmpcpp.PoseDmp.fit(demonstration).rollout(dt=0.1), "pose twist acceleration"),
        (dmpcpp.Dmp.fit(demonstration.position).rollout(dt=0.1), "position velocity acceleration"),
        (
            dmpcpp.OrientationDmp.fit(demonstration.orientation).rollout(dt=0.1),
            "rotation angular_velocity angular_acceleration",
        ),
        (dmpcpp.JointTrajectory.through(time, np.c_[time, time**3], ["a", "b"]), "position velocity acceleration"),
    ]
    for motion, names in motions:
        again = pickle.loads(pickle.dumps(motion))
        for name in ("time", *names.split()):
            assert (getattr(again, name) == getattr(motion, name)).all(), name
    assert again.joint_names == ["a", "b"]
    assert again.report.complete == motion.report.complete


def test_quaternions_in_either_order_make_the_same_demonstration():
    time = np.linspace(0.0, 1.0, 20)
    rotation = np.array([dmpcpp.so3.exp([0.3 * t, 0.1, t]) for t in time])
    xyzw = Rotation.from_matrix(rotation).as_quat()
    turned = dmpcpp.OrientationDemonstration.from_quaternions(time, xyzw, "xyzw")
    np.testing.assert_allclose(turned.rotation, rotation, atol=1e-15)
    both = dmpcpp.PoseDemonstration.from_quaternions(time, np.c_[time, time, time], -np.roll(xyzw, 1, axis=1), "wxyz")
    np.testing.assert_allclose(both.pose[:, :3, :3], rotation, atol=1e-15)
    with pytest.raises(InvalidArgument, match="order: 'zyx' is unknown, expected wxyz or xyzw"):
        dmpcpp.OrientationDemonstration.from_quaternions(time, xyzw, "zyx")


def test_a_class_that_adds_to_options_keeps_its_fields_through_a_pickle():
    assert Extended(alpha=5.0) != Extended(alpha=6.0)
    assert repr(Extended(alpha=5.0)) == "Extended(alpha=5.0)"
    assert pickle.loads(pickle.dumps(Extended(alpha=5.0))).alpha == 5.0


class Extended(dmpcpp.DmpOptions):
    pass


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"kernels": 3}, "kernels: 3 is unknown, expected one of equal_in_time, source"),
        ({"kernels": dmpcpp.Scaling.none}, r"kernels: <Scaling.none: 0> is unknown, expected one of"),
        ({"source": 3}, "options: 'source' is unknown"),
        ({"__eq__": 3}, "options: '__eq__' is unknown"),
    ],
)
def test_what_is_no_field_or_no_enumerator_is_refused_by_name(fields, message):
    with pytest.raises(InvalidArgument, match=message):
        dmpcpp.DmpOptions(**fields)
    with pytest.raises(InvalidArgument, match=message):
        Dmp.fit(helix(), **fields)


def test_a_message_about_a_name_that_is_no_text_can_be_read():
    with pytest.raises(dmpcpp.FileError, match=r"xff.json: cannot be read"):
        dmpcpp.load(b"/no/such/\xff.json")
    with pytest.raises(dmpcpp.FileError, match=r"xff.urdf: cannot be read"):
        dmpcpp.Arm.from_urdf_file("/no/such/\udcff.urdf")
