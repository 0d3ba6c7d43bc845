# Writes pcl_ascii.pcd: 300 points on a grid, and 2 invalid ones.
with open("pcl_ascii.pcd", "w") as file:
    file.write("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n")
    file.write("WIDTH 302\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 302\nDATA ascii\n")
    for i in range(300):
        file.write(f"{i % 20 * 0.25} {i // 20 * 0.5 - 3.3} {i % 7 * 0.1} {i % 32}\n")
    file.write("nan nan nan 0\nnan 1 1 0\n")
