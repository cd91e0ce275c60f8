w.standard.map = NotImplemented
w.group.label = hostile.deep()
r2 = None.vendor