"""Tern as a module of DimOS: a planner that flies its drone around obstacles.

Copy this file into your blueprint's package. `autoconnect` joins the ports by name and type; DimOS starts and ends the
program. See docs/howto/drone_dimos.md.

    autoconnect(drone_basic, my_detector, TernPlanner.blueprint(scenario="/etc/tern/hawk.yaml"))
"""
from dimos.core.native_module import NativeModule, NativeModuleConfig
from dimos.core.stream import In, Out
from dimos.msgs.geometry_msgs.PoseStamped import PoseStamped
from dimos.msgs.geometry_msgs.Twist import Twist
from dimos.msgs.nav_msgs.Path import Path
from dimos.msgs.sensor_msgs.PointCloud2 import PointCloud2
from dimos.msgs.tf2_msgs.TFMessage import TFMessage
from dimos.msgs.vision_msgs.Detection3DArray import Detection3DArray


class TernPlannerConfig(NativeModuleConfig):
    executable: str = "/usr/bin/tern-dimos"
    scenario: str  # the file that Tern's other processes have
    lcm_url: str = "udpm://239.255.76.67:7668?ttl=0"  # Tern's own network, beside DimOS's
    dimos_url: str | None = None  # if DimOS does not use its default
    cli_name_override: dict[str, str] = {"scenario": "config", "lcm_url": "lcm-url"}


class TernPlanner(NativeModule):
    config: TernPlannerConfig

    odom: In[PoseStamped]
    goal_request: In[PoseStamped]
    detections: In[Detection3DArray]
    lidar: In[PointCloud2]
    tf: In[TFMessage]

    cmd_vel: Out[Twist]
    path: Out[Path]
