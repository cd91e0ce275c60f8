r0 = cc.fresnel(np.ones((4, 8, 3), 'f4'), w.skin)
r1 = cc.CubeMap(np.ones((6, 2, 2, 4), np.uint8)).save(Path('a.ktx2'), layout=None, width=(), center=hostile.deep(), tonemap=None, compression='zlib')
r2 = w.texture.source
w.flat.near = 4