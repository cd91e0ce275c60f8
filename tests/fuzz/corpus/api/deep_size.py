w.screen.size = hostile.deep()
r1 = w.group.look_at(np.ones((4, 8, 3), 'f4'))
w.standard.specular_map = w.screen
r3 = cc.Stencil(reference=10**30, read_mask=np.array(['a', 'b']), fail=inf, depth_pass=Path('a.png'))