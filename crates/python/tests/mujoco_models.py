"""Models for the tests of ``alberti.mujoco``, as MJCF."""

BALL = '<mujoco><worldbody><geom type="sphere" size=".3"/></worldbody></mujoco>'

PRIMITIVES = """<mujoco><asset>
<texture name="grid" type="2d" builtin="checker" rgb1=".2 .3 .4" rgb2=".1 .2 .3" width="64"
  height="64" mark="edge" markrgb=".8 .8 .8"/>
<texture type="skybox" builtin="gradient" rgb1=".3 .5 .7" rgb2="0 0 0" width="64" height="384"/>
<texture name="cube" type="cube" builtin="checker" rgb1="1 .5 .2" rgb2=".2 .5 1" width="32"
  height="32"/>
<material name="grid" texture="grid" texrepeat="2 2" texuniform="true"/>
<material name="cube" texture="cube"/>
<material name="shiny" rgba=".8 .1 .1 1" specular="1" shininess=".9"/></asset>
<worldbody><light pos="0 0 4" dir="0 0 -1" directional="true"/>
<camera name="side" pos="2.5 -2 1.6" xyaxes=".62 .78 0 -.35 .28 .89"/>
<geom type="plane" size="0 0 .05" material="grid"/>
<body pos="0 0 .6"><freejoint/><geom type="box" size=".15 .2 .1" rgba=".9 .6 .1 1"/></body>
<body pos=".6 0 .6" euler="20 30 0"><freejoint/>
  <geom type="capsule" size=".1 .25" material="shiny"/></body>
<body pos="-.6 0 .6"><freejoint/><geom type="sphere" size=".2" material="cube"/></body>
<body pos="0 .6 .6" euler="50 0 30"><freejoint/>
  <geom type="cylinder" size=".15 .1" rgba=".1 .6 .2 1"/></body>
<body pos="0 -.6 .6" euler="50 0 30"><freejoint/>
  <geom type="ellipsoid" size=".15 .1 .25" rgba=".4 .1 .6 1"/></body>
<body pos=".6 .6 .6" euler="10 20 30"><freejoint/>
  <geom type="box" size=".15 .15 .15" material="cube"/></body>
<body pos="-.6 .6 .6"><freejoint/><geom type="sphere" size=".15" rgba="0 .5 1 .4"/></body>
</worldbody></mujoco>"""

HEIGHTS = " ".join(
    str(round(((at % 30) * 7 + at // 30 * 13) % 17 / 17, 3)) for at in range(600)
)
TERRAIN = f"""<mujoco><asset>
<hfield name="h" nrow="20" ncol="30" size="2 1.5 .4 .1" elevation="{HEIGHTS}"/></asset>
<worldbody><light pos="0 0 3" dir="0 .2 -1"/><geom type="hfield" hfield="h" rgba=".5 .6 .3 1"/>
<body pos="0 0 1.2"><freejoint/><geom type="sphere" size=".2" rgba=".8 .2 .2 1"/></body>
</worldbody></mujoco>"""

MESHES = """<mujoco><asset><mesh name="t" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/>
<mesh name="p" vertex="-1 -1 0 1 -1 0 1 1 0 -1 1 0 0 0 1.5"/></asset>
<worldbody><light pos="1 1 3" dir="-.3 -.3 -1" directional="true"/>
<geom type="plane" size="2 2 .1" rgba=".7 .7 .7 1"/>
<body pos="0 0 .5"><freejoint/><geom type="mesh" mesh="t" rgba=".2 .7 .9 1"/></body>
<body pos="1 -1 .8"><freejoint/><geom type="mesh" mesh="p" rgba=".9 .3 .3 1"/></body>
</worldbody></mujoco>"""

TENDON = """<mujoco><worldbody><light pos="0 0 3"/><geom type="plane" size="1 1 .1"/>
<site name="a" pos="0 0 1.5" size=".03"/>
<body pos=".3 0 .8"><joint type="hinge" axis="0 1 0" damping=".1"/>
<geom type="capsule" fromto="0 0 0 .3 0 0" size=".04"/>
<site name="b" pos=".3 0 0" size=".05" type="box"/></body></worldbody>
<tendon><spatial width=".01" rgba="1 0 0 1"><site site="a"/><site site="b"/></spatial></tendon>
</mujoco>"""

CLOTH = """<mujoco><worldbody><light pos="0 0 3" dir="0 0 -1" directional="true"/>
<geom type="plane" size="2 2 .1" rgba=".6 .6 .6 1"/>
<geom type="sphere" size=".2" pos="0 0 .3" rgba=".3 .3 .9 1"/>
<flexcomp name="f" type="grid" count="9 9 1" spacing=".1 .1 .1" pos="0 0 .8" radius=".01" dim="2"
  mass="1" rgba=".9 .5 .2 1"><contact selfcollide="none"/><edge equality="true"/></flexcomp>
</worldbody></mujoco>"""


def crowd(count=32):
    """Return a plane with bodies of every kind, ``count`` geoms in all."""
    kinds = ("box", "sphere", "capsule", "cylinder", "ellipsoid")
    bodies = []
    for at in range(count - 1):
        x, y, z = (at * 7 % 11 - 5) / 5, (at * 5 % 13 - 6) / 6, 0.4 + at % 8 / 8
        color = f"{at * 3 % 10 / 10} {at * 7 % 10 / 10} {at % 10 / 10} 1"
        geom = f'<geom type="{kinds[at % 5]}" size=".08 .1 .12" rgba="{color}"/>'
        bodies.append(f'<body pos="{x} {y} {z}"><freejoint/>{geom}</body>')
    light = '<light pos="0 0 4" dir="0 .2 -1" directional="true"/>'
    plane = '<geom type="plane" size="2 2 .1"/>'
    return f"<mujoco><worldbody>{light}{plane}{''.join(bodies)}</worldbody></mujoco>"


SCENES = {
    "primitives": PRIMITIVES,
    "terrain": TERRAIN,
    "meshes": MESHES,
    "tendon": TENDON,
    "cloth": CLOTH,
    "crowd": crowd(),
}
