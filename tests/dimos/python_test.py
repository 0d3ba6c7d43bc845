"""python_test.py TERN_DIMOS: the example's class makes a command line that the program takes.

DimOS itself is not there. Stand-ins make the arguments as its documentation of native modules says: a port is --NAME CHANNEL,
a field of the configuration --NAME VALUE; None is left out, truth values are lower case, lists are joined by commas.
"""
import pathlib
import subprocess
import sys
import tempfile
import types
import typing

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True


class Port:
    def __class_getitem__(cls, message):
        return types.SimpleNamespace(message=message)


class NativeModuleConfig:
    pass


def stand_in(name, **members):
    module = types.ModuleType(name)
    module.__dict__.update(members)
    sys.modules[name] = module


stand_in("dimos.core.native_module", NativeModule=type("NativeModule", (), {}), NativeModuleConfig=NativeModuleConfig)
stand_in("dimos.core.stream", In=Port, Out=Port)
for name in ("geometry_msgs.PoseStamped", "geometry_msgs.Twist", "nav_msgs.Path", "sensor_msgs.PointCloud2",
             "tf2_msgs.TFMessage", "vision_msgs.Detection3DArray"):
    stand_in(f"dimos.msgs.{name}", **{name.split(".")[1]: name})
sys.path.insert(0, str(ROOT / "docs/examples"))
import dimos_planner  # noqa: E402


def text(value):
    if isinstance(value, bool):
        return str(value).lower()
    return ",".join(map(str, value)) if isinstance(value, list) else str(value)


def command_line(module, program, **given):
    config = typing.get_type_hints(module, vars(dimos_planner))["config"]
    words = [program]
    for name, port in module.__annotations__.items():
        if name != "config":
            words += [f"--{name}", f"/{name}#{port.message}"]
    names = config.cli_name_override
    for name in config.__annotations__:
        value = given.get(name, getattr(config, name, None))
        if name not in ("executable", "cli_name_override") and value is not None:
            words += [f"--{names.get(name, name)}", text(value)]
    return words


with tempfile.TemporaryDirectory() as folder:
    scenario = pathlib.Path(folder) / "hawk.yaml"
    scenario.write_text("dimos: {world: {yaw_deg: 90}, lateral: right}\n")
    words = command_line(dimos_planner.TernPlanner, sys.argv[1], scenario=scenario, dimos_url="udpm://239.255.76.67:7669?ttl=0")
    assert "--cmd_vel" in words and "/odom#geometry_msgs.PoseStamped" in words, words
    result = subprocess.run([*words, "--check-config"], capture_output=True, text=True)
    assert result.returncode == 0, (words, result.stderr)
