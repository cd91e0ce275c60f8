(w.standard if r3 is None else r3).occlusion_strength = 2
r1 = w.standard.clearcoat_roughness_map
r2 = cc.brdf(hostile.wide(2**31, dtype=np.uint32), np.ones((4, 4, 3), np.uint8))