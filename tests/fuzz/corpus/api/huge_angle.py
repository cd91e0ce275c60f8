r0 = cc.navigation.yaw(2**63, -10**400)
r1 = cc.PerspectiveCamera().__setstate__(cc.GlassMaterial.__new__(cc.GlassMaterial))
w.standard.occlusion_map = cc.CubeMap.__new__(cc.CubeMap)
w.sun.parent = w.bent