w.screen.depth_format = 'depth32f_stencil8'
r1 = (w.cube if r1 is None else r1).save_for(hostile.deep(), cc.Skin.__new__(cc.Skin))
w.standard.occlusion_strength = 1
r3 = cc.CubeMap(np.ones((6, 2, 2, 4), np.uint8)).__deepcopy__(w.shader)